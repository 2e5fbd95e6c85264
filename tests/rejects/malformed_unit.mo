// code: U005
// line: 5
// hint: N.m.s/rad
model M
  Real x(unit = "m//s");
equation
  x = time;
end M;
