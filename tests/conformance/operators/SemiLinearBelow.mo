// section: 3.7.4.5
// value: z = -3, w = 5
model SemiLinearBelow
  Real z = semiLinear(-1, 5, 3), w = semiLinear(1, 5, 3);
end SemiLinearBelow;
