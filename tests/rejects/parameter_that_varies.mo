// code: R055
// line: 6
// hint: remove
model M
  Real x = time;
  parameter Real p = 2*x;
end M;
