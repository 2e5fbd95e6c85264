// section: 10.3.5
// value: a[2,1] = 2, a[1,2] = 2, a[2,2] = 4
model Symmetric
  Real a[2, 2] = symmetric([1, 2; 3, 4]);
end Symmetric;
