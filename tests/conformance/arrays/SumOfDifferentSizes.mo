// section: 10.6.2
// refuse: R042 4
model SumOfDifferentSizes
  Real x[2] = {1, 2} + {1, 2, 3};
end SumOfDifferentSizes;
