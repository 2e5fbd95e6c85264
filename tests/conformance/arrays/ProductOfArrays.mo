// section: 10.3.4.1
// refuse: R051 4
model ProductOfArrays
  Real x = product({1, 2} for i in 1:3);
end ProductOfArrays;
