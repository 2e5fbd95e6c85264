// section: 10.3.5
// value: d = 0, s[1,2] = -3, s[3,2] = 1
model Skew
  Real s[3, 3] = skew({1, 2, 3});
  Real y[3] = {4, 5, 6};
  Real d = sum((s*y - cross({1, 2, 3}, y)).^2);
end Skew;
