// code: F037
// line: 7
// hint: as meant
model M
  Real x;
equation
  x = sum(i*j for i in 1:1000, j in 1:1000)*time;
end M;
