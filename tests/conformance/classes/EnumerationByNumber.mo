// section: 4.9.5.3
// value: b = true
model EnumerationByNumber
  type E = enumeration(x, y, z);
  parameter E e = E(3);
  Boolean b = e == E.z;
end EnumerationByNumber;
