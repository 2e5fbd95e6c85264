// section: 10.5
// refuse: R045 5
model IndexOutside
  Real a[3] = {1, 2, 3};
  Real x = a[4];
end IndexOutside;
