// code: R011
// line: 6
// hint: break the circle
model M
  Real x;
  M inner_m;
equation
  x = time;
end M;
