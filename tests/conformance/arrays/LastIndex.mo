// section: 10.5.2
// value: x = 3, y = 30, z = 2
model LastIndex
  Real a[3] = {1, 2, 3}, b[2, 3] = [10, 20, 30; 40, 50, 60];
  Integer k[2] = {2, 1};
  Real x = a[end], y = b[end - 1, end], z = a[k[end - 1]];
end LastIndex;
