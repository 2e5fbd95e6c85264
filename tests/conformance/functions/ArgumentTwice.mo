// section: 12.4.1
// refuse: R050 10
model ArgumentTwice
  function f
    input Real a;
    output Real c;
  algorithm
    c := a;
  end f;
  Real y = f(1, a=2);
end ArgumentTwice;
