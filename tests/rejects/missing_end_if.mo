// code: P009
// line: 11
// hint: close the
model M
  Real x;
equation
  if time > 1 then
    x = 1;
  else
    x = 0;
end M;
