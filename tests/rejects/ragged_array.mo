// code: R040
// line: 7
// hint: same size
model M
  Real x[2, 2];
equation
  x = {{1, 2}, {3}};
end M;
