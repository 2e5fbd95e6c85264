// section: 4.9.5
// value: k at 0.2 = 1, isA at 0.2 = true, k = 2, isA = false
model FirstLiteral "an enumeration without a start value begins with its first literal"
  type E = enumeration(a, b, c);
  E e;
  Integer k = Integer(e);
  Boolean isA = e == E.a;
equation
  when time > 0.5 then
    e = E.b;
  end when;
end FirstLiteral;
