// section: 4.9.5
// refuse: R074 4
model LiteralTwice
  type E = enumeration(a, b, a);
  parameter E e = E.a;
end LiteralTwice;
