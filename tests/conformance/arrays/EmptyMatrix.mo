// section: 10.7
// value: s = 0, n = 0, m = 3
model EmptyMatrix
  Real x[0, 3];
  Real s = sum(x);
  Integer n = size(x, 1);
  Integer m = size(x, 2);
end EmptyMatrix;
