// code: P016
// line: 7
// hint: parentheses
model M
  Real x;
equation
  x = 2*-time;
end M;
