// section: 10.5
// refuse: R044 5
model RealIndex
  Real x[3] = {1, 2, 3};
  Real y = x[2.0];
end RealIndex;
