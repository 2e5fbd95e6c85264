// section: 10.7
// value: n = 0, s = 0, p = 1
model EmptyVector
  Real x[0];
  Integer n = size(x, 1);
  Real s = sum(x), p = product(x);
end EmptyVector;
