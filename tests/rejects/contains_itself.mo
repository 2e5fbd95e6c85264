// code: R011
// line: 6
// hint: contain itself
model M
  Real x;
  M inner_m;
equation
  x = time;
end M;
