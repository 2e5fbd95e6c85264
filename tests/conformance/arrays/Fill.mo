// section: 10.3.3
// value: a[2,3] = 7, s = 42
model Fill
  Real a[2, 3] = fill(7*time, 2, 3);
  Real s = sum(a);
end Fill;
