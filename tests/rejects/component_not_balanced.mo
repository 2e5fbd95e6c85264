// code: R078
// line: 4
// hint: as many equations
model A
  Real x;
  Real y;
equation
  x = 1;
end A;
model M
  A a;
equation
  a.y = 2;
end M;
