// code: R024
// line: 7
// hint: integer(x)
model M
  Integer n;
equation
  n = 2.5*time;
end M;
