// section: 10.6.4
// value: s = 32
model ProductOfVectors
  Real s = {1, 2, 3}*{4, 5, 6};
end ProductOfVectors;
