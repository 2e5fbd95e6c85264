// code: P003
// line: 7
// hint: did you mean then
model M
  Real x;
equation
  x = if time > 1 than 1 else 0;
end M;
