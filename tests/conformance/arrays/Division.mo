// section: 10.6.6
// refuse: R042 5
model Division
  Real a[2] = {1, 2};
  Real b[2] = 2/a;
end Division;
