// section: 4.9.5.3
// refuse: R045 5
model EnumerationNumberOutside
  type E = enumeration(one, two);
  parameter E e = E(3);
  Real x = if e == E.two then 1 else 0;
end EnumerationNumberOutside;
