// code: R046
// line: 7
// hint: constant 0
model M
  Real x;
equation
  x = time/0;
end M;
