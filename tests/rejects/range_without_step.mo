// code: R047
// line: 7
// hint: other than 0
model M
  Real x;
equation
  x = sum(1:0:3);
end M;
