// code: U003
// line: 8
// hint: same unit
model M
  Real s(unit = "m") = 2;
  Real x;
equation
  x = sin(s);
end M;
