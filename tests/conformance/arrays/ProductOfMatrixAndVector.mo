// section: 10.6.4
// value: y[1] = 5, y[2] = 11, z[1] = 7
model ProductOfMatrixAndVector
  Real a[2, 2] = [1, 2; 3, 4];
  Real y[2] = a*{1, 2}, z[2] = {1, 2}*a;
end ProductOfMatrixAndVector;
