// code: R043
// line: 6
// hint: sizes are from 0
model M
  parameter Integer n = -1;
  Real x[n];
equation
  x = zeros(n);
end M;
