// section: 3.7.4.5
// value: y at 0.25 = -1, y = 2
model SemiLinear
  Real x = 2*time - 1;
  Real y = semiLinear(x, 2, 2);
  Real z = semiLinear(-1, 5, 3);
end SemiLinear;
