// code: P001
// line: 7
// hint: plain ASCII
model M
  Real x;
equation
  x = 2·time;
end M;
