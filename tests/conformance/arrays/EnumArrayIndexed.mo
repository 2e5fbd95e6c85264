// section: 10.5
// value: y = 20, s = 60
model EnumArrayIndexed "an enumeration as a size"
  type E = enumeration(a, b, c);
  Real x[E] = {10, 20, 30}*time;
  Real y = x[E.b], s = sum(x[e] for e in E);
end EnumArrayIndexed;
