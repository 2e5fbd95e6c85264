// code: P002
// line: 5
// hint: close it
model M
  Real x "the speed;
equation
  x = time;
end M;
