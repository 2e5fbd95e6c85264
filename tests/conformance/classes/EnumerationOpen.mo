// section: 4.9.5
// value: n = 2
model EnumerationOpen
  replaceable type E = enumeration(:);
  type F = enumeration(a, b);
  parameter F f = F.b;
  Integer n = Integer(f);
end EnumerationOpen;
