// section: 10.3.4
// value: k = 3
model MaxOfEnums "the largest of two literals"
  type E = enumeration(a, b, c);
  parameter E e = max(E.a, E.c);
  parameter Integer k = Integer(e);
  Real x = time;
end MaxOfEnums;
