// code: R044
// line: 8
// hint: dimension
model M
  Real x, y;
equation
  x = time;
  y = x[1];
end M;
