// code: P008
// line: 8
// hint: ==
model M
  parameter Integer n = 1;
  Real x;
equation
  x = if n = 1 then 1 else 0;
end M;
