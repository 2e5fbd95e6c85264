// code: P005
// line: 8
// hint: write end Motor;
model Motor
  Real x;
equation
  x = time;
end Moter;
