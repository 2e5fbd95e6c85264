// section: 12.4.1
// refuse: R050 11
model ArgumentMissing
  function f
    input Real a;
    input Real b;
    output Real c;
  algorithm
    c := a + b;
  end f;
  Real y = f(1);
end ArgumentMissing;
