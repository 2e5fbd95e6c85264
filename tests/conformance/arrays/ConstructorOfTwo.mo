// section: 10.4.1
// value: a[1,2] = 12, a[3,1] = 31
model ConstructorOfTwo
  Real a[3, 2] = {10*j + i for i in 1:2, j in 1:3};
end ConstructorOfTwo;
