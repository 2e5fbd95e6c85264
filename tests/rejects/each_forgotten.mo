// code: R036
// line: 5
// hint: each
model M
  Real x[3](start = 1);
equation
  der(x) = -x;
end M;
