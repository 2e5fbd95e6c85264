// section: 4.9.5
// refuse: R021 5
model SumOfEnumeration
  type E = enumeration(a, b);
  Integer n = E.b + 1;
end SumOfEnumeration;
