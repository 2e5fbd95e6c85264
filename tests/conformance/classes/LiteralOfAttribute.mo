// section: 4.9.5
// refuse: R074 4
model LiteralOfAttribute
  type E = enumeration(a, min);
  parameter E e = E.a;
end LiteralOfAttribute;
