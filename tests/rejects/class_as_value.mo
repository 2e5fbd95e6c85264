// code: R018
// line: 10
// hint: components or constants
model Motor
  Real w = time;
end Motor;
model M
  Real x;
equation
  x = Motor;
end M;
