// section: 10.3.4.1
// value: s = 18, m = 6, p = 36
model ReductionOfTwo
  Real s = sum(i*j for i in 1:2, j in 1:3);
  Real m = max(i*j for i in 1:2, j in 1:3);
  Real p = product(i for i in 1:3)*product(j for j in {1, 6});
end ReductionOfTwo;
