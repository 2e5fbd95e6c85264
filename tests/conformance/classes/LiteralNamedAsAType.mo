// section: 2.3.3
// refuse: R074 4
model LiteralNamedAsAType "an enumeration literal with the name of a built-in type"
  type E = enumeration(Real, Imag);
  E e = E.Imag;
end LiteralNamedAsAType;
