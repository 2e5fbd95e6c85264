// code: R050
// line: 7
// hint: by position
model M
  Real x;
equation
  x = sin(time, 2);
end M;
