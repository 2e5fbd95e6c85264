// code: P017
// line: 13
// hint: keep one
function f
  input Real a;
  output Real b;
algorithm
  b := a;
end f;
model M
  Real x;
equation
  x = f(a = 1, a = time);
end M;
