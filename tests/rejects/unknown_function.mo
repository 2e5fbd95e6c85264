// code: R004
// line: 7
// hint: did you mean sqrt
model M
  Real x;
equation
  x = sqrrt(time);
end M;
