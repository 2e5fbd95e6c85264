// section: 10.5
// value: y = 2
model EnumerationIndex
  type E = enumeration(a, b, c);
  Real x[E] = {1, 2, 3};
  Real y = x[E.b];
end EnumerationIndex;
