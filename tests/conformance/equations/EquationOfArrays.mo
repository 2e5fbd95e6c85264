// section: 8.3.1
// value: x[1] = 3, x[2] = 6
model EquationOfArrays
  Real x[2];
equation
  x = 3*{1, 2};
end EquationOfArrays;
