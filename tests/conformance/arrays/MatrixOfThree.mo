// section: 10.3.3
// value: m[1,2] = 2, m[2,1] = 3
model MatrixOfThree
  Real a[2, 2, 1] = {{{1}, {2}}, {{3}, {4}}};
  Real m[2, 2] = matrix(a);
end MatrixOfThree;
