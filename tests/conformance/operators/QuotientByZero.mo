// section: 3.7.2
// refuse: R046 5
model QuotientByZero
  Integer m = 5;
  Integer n = div(m, 0);
end QuotientByZero;
