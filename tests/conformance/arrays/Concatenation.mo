// section: 10.4.2
// value: a[1,3] = 5, b[3] = 3, c[2,1] = 3
model Concatenation
  Real a[2, 3] = cat(2, [1, 2; 3, 4], [5; 6]);
  Real b[3] = cat(1, {1}, {2, 3});
  Real c[2, 2] = [1, 2; 3, 4];
end Concatenation;
