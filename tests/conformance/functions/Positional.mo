// section: 12.4.1
// value: y = 7
model Positional
  function f
    input Real a;
    input Real b;
    output Real c = 2*a + b;
  algorithm
  end f;
  Real y = f(3, 1);
end Positional;
