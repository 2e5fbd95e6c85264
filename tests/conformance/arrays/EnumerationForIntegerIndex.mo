// section: 10.5
// refuse: R044 6
model EnumerationForIntegerIndex
  type E = enumeration(a, b, c);
  Real x[3] = {1, 2, 3};
  Real y = x[E.b];
end EnumerationForIntegerIndex;
