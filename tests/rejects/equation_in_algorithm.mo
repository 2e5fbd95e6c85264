// code: P004
// line: 7
// hint: write :=
model M
  Real x;
algorithm
  x = time;
end M;
