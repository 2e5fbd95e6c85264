// section: 10.6.7
// value: x[2] = 9, y[2] = 8
model ElementwisePower
  Real x[2] = {2, 3}.^2;
  Real y[2] = 2 .^ {2, 3};
end ElementwisePower;
