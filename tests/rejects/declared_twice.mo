// code: R010
// line: 6
// hint: rename
model M
  Real x;
  Integer x;
equation
  x = 1;
end M;
