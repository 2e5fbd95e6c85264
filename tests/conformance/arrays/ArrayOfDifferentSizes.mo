// section: 10.4
// refuse: R040 4
model ArrayOfDifferentSizes
  Real x[2, 2] = {{1, 2}, {3}};
end ArrayOfDifferentSizes;
