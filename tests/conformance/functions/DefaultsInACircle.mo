// section: 12.4.1
// refuse: F022 11
model DefaultsInACircle
  function f
    input Real a = b;
    input Real b = a;
    output Real c;
  algorithm
    c := a + b;
  end f;
  Real y = f();
end DefaultsInACircle;
