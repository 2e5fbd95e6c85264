// code: P008
// line: 7
// hint: single =
model M
  Real x;
equation
  x == time;
end M;
