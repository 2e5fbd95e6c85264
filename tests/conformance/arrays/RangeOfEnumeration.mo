// section: 10.4.3
// value: x[1] = 1, x[2] = 2, x[3] = 7
model RangeOfEnumeration
  type E = enumeration(a, b, c);
  Real x[E];
equation
  for e in E.a:E.b loop
    x[e] = Integer(e);
  end for;
  x[E.c] = 7;
end RangeOfEnumeration;
