// section: 10.5
// value: x[1] = 5, x[2] = 7, y = 7
model BooleanIndex
  Real x[Boolean];
  Real y = x[time > 0.5];
equation
  x[false] = 5;
  x[true] = 7;
end BooleanIndex;
