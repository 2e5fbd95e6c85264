// section: 10.6.8
// value: a[1,1] = 7, a[1,2] = 10, b[1,1] = 1, b[2,1] = 0
model MatrixPower
  Real a[2, 2] = [1, 2; 3, 4]^2;
  Real b[2, 2] = [1, 2; 3, 4]^0;
end MatrixPower;
