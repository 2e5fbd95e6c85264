// section: 9.1
// refuse: R061 18
model TooDeep
  connector C
    Real e;
    flow Real f;
  end C;
  model A
    C c;
  equation
    c.e = 1;
  end A;
  model B
    A a1, a2;
  end B;
  B b;
equation
  connect(b.a1.c, b.a2.c);
end TooDeep;
