// code: R042
// line: 7
// hint: same size
model M
  Real x[3];
equation
  x = {time, 2*time};
end M;
