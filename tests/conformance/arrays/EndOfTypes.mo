// section: 10.5.2
// value: x = 2, y = 4, z = 6
model EndOfTypes
  Real A[2, 2] = [1, 2; 3, 4];
  Integer v[2] = {1, 2};
  Real x = A[end - 1, end];
  Real y = A[v[end], end];
  Real B[Boolean] = {5, 6};
  Real z = B[end];
end EndOfTypes;
