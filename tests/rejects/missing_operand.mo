// code: P007
// line: 7
// hint: after *
model M
  Real x;
equation
  x = 2*;
end M;
