// code: U005
// line: 5
// hint: N.m.s/rad
model M
  Real x(unit = "furlong");
equation
  x = time;
end M;
