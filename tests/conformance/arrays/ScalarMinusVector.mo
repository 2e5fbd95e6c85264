// section: 10.6.3
// refuse: R042 4
model ScalarMinusVector
  Real y[2] = 3 - {2, 4};
end ScalarMinusVector;
