// section: 10
// value: n = 3, x[2] = 5, k = 2
model IndexedByATypeOfAnotherName
  type F = enumeration(a, b, c);
  type E = F;
  parameter Integer n = size({e for e in E}, 1);
  Real x[E] = {4, 5, 6};
  Integer k = Integer(E.b);
end IndexedByATypeOfAnotherName;
