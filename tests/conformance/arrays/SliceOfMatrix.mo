// section: 10.5.1
// value: r[2] = 5, c[2] = 6, s[1,1] = 2
model SliceOfMatrix
  Real a[2, 3] = [1, 2, 3; 4, 5, 6];
  Real r[3] = a[2, :], c[2] = a[:, 3], s[2, 2] = a[:, {2, 3}];
end SliceOfMatrix;
