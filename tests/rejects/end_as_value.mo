// code: R048
// line: 7
// hint: last index
model M
  Real x;
equation
  x = end + 1;
end M;
