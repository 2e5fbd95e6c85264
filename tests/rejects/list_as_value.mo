// code: R023
// line: 7
// hint: {a, b}
model M
  Real x[2];
equation
  x = (time, 2*time);
end M;
