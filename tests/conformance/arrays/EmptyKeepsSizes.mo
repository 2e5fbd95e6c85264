// section: 10.7
// value: n = 0, m = 3
model EmptyKeepsSizes
  Real a[2, 3] = ones(2, 3);
  Integer n = size(a[1:0, :], 1), m = size(a[1:0, :], 2);
end EmptyKeepsSizes;
