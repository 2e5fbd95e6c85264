// code: P015
// line: 7
// hint: and
model M
  Real x;
equation
  x = if 0 < time < 1 then 1 else 0;
end M;
