// section: 10.3.4
// value: m = 6, s = 6, p = 4, y[1] = 3, y[2] = 6, n = 1, k = 3
model ReductionsOfArraysInBraces "in braces it is an array, of which all elements are taken; without, what is summed"
  Real m = max({{i*j*time for i in 1:3} for j in 1:2});
  Real s = sum({{1, 2}*time for j in 1:2});
  Real p = product({{i, j}*time for i in 1:2, j in 1:2})/4;
  Real y[2] = sum({1, 2}*j*time for j in 1:2);
  Integer n = size({{i for i in 1:3}}, 1), k = size({{i for i in 1:3}}, 2);
end ReductionsOfArraysInBraces;
