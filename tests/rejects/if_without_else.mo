// code: P014
// line: 7
// hint: if c then a else b
model M
  Real x;
equation
  x = if time > 1 then 2;
end M;
