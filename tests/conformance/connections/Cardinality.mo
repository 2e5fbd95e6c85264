// section: 3.7.4.3
// value: a.n = 2, b.n = 1, c.n = 1
model Cardinality
  connector C
    Real e;
    flow Real f;
  end C;
  model M
    C c;
    Integer n = cardinality(c);
  equation
    c.f = 0;
  end M;
  model E
    C c;
    Integer n = cardinality(c);
  equation
    c.e = 1;
  end E;
  E a;
  M b, c;
equation
  connect(a.c, b.c);
  connect(c.c, a.c);
end Cardinality;
