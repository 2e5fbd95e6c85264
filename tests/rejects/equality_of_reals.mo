// code: R022
// line: 7
// hint: tolerance
model M
  Real x;
equation
  x = if time == 1 then 1 else 0;
end M;
