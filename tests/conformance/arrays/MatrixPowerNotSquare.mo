// section: 10.6.8
// refuse: R042 4
model MatrixPowerNotSquare
  Real a[2, 3] = [1, 2, 3; 4, 5, 6]^2;
end MatrixPowerNotSquare;
