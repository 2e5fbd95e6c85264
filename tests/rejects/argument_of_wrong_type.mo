// code: R062
// line: 13
// hint: give a Real
function half
  input Real a;
  output Real b;
algorithm
  b := a/2;
end half;
model M
  Real x;
equation
  x = half(time > 1);
end M;
