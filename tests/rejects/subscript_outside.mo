// code: R045
// line: 9
// hint: start at 1
model M
  Real x[3];
equation
  x[1] = time;
  x[2] = time;
  x[3] = x[0];
end M;
