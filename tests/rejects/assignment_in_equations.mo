// code: P004
// line: 7
// hint: write =
model M
  Real x;
equation
  x := time;
end M;
