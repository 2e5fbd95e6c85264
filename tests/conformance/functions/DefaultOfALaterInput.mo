// section: 12.4.1
// value: y = 7
model DefaultOfALaterInput
  function f
    input Real a = b + 1;
    input Real b;
    output Real c;
  algorithm
    c := a + b;
  end f;
  Real y = f(b=3);
end DefaultOfALaterInput;
