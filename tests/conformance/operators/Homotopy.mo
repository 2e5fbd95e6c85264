// section: 3.7.4.4
// value: y = 2, z = 2
model Homotopy
  Real y = homotopy(2*time, 3*time);
  Real z = homotopy(simplified=1, actual=2);
end Homotopy;
