// code: R061
// line: 8
// hint: joins connectors
model M
  Real x, y;
equation
  x = time;
  connect(x, y);
end M;
