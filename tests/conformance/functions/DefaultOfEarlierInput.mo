// section: 12.4.1
// value: x = 7, y = 12
model DefaultOfEarlierInput
  function f
    input Real a;
    input Real b = 2*a;
    input Real c = 1;
    output Real y;
  algorithm
    y := a + b + c;
  end f;
  Real x = f(2);
  Real y = f(2, c=4, b=6);
end DefaultOfEarlierInput;
