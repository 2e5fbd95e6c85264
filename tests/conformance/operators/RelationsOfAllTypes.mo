// section: 3.5
// value: b = true, c = true, d = true
model RelationsOfAllTypes
  type E = enumeration(a, b, c);
  parameter E e = E.b;
  Boolean b = e > E.a and e < E.c;
  Boolean c = "ab" < "b";
  Boolean d = false < true;
end RelationsOfAllTypes;
