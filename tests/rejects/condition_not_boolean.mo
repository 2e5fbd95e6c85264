// code: R020
// line: 7
// hint: comparison
model M
  Real x;
equation
  x = if time then 1 else 0;
end M;
