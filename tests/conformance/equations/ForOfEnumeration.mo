// section: 8.3.3
// value: x[2] = 2
model ForOfEnumeration
  type E = enumeration(a, b);
  Real x[E];
equation
  for e in E loop
    x[e] = Integer(e);
  end for;
end ForOfEnumeration;
