// section: 10.5
// refuse: R044 6
model IntegerForEnumerationIndex
  type E = enumeration(a, b, c);
  Real x[E] = {1, 2, 3};
  Real y = x[2];
end IntegerForEnumerationIndex;
