// section: 12.4.1
// value: y = 9
model DefaultOfAnotherInput
  function f
    input Real a; input Real b = 2*a; output Real y = a + b;
  algorithm
  end f;
  Real y = f(3);
end DefaultOfAnotherInput;
