// section: 10.3.3
// value: x[1] = 1, x[2] = 1.5, x[3] = 2
model Linspace
  Real x[3] = linspace(1, 2, 3);
end Linspace;
