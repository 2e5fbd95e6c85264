// code: P020
// line: 5
// hint: write for example Real
model M
  x;
equation
  x = time;
end M;
