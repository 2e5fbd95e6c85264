// code: P006
// line: 8
// hint: end the line above
model M
  Real x;
  Real y;
equation
  x = time
  y = 2*x;
end M;
