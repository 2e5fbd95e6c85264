// section: 8.3.1
// refuse: R042 6
model EquationOfSizes
  Real x[2];
equation
  x = {1, 2, 3};
end EquationOfSizes;
