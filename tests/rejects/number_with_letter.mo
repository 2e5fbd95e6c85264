// code: P011
// line: 8
// hint: 2*x
model M
  Real x, y;
equation
  x = time;
  y = 2x;
end M;
