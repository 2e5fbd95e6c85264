// section: 12.4.1
// value: y = 12, z = 5
model DefaultInput
  function f
    input Real a;
    input Real b = 3*a;
    output Real c;
  algorithm
    c := a + b;
  end f;
  Real y = f(3), z = f(3, 2);
end DefaultInput;
