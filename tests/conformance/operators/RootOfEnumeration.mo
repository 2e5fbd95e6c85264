// section: 4.9.5
// refuse: R021 6
model RootOfEnumeration
  type E = enumeration(a, b);
  parameter E e = E.a;
  Real y = sqrt(e);
end RootOfEnumeration;
