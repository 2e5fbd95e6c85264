// section: 4.4.5
// value: y = 1
model Conditional
  connector C
    Real e;
    flow Real f;
  end C;
  model M
    parameter Boolean wanted = false;
    C c if wanted;
  end M;
  model N
    C c;
  equation
    c.e = 1;
  end N;
  M m;
  N n;
  Real y = n.c.e;
equation
  connect(m.c, n.c);
end Conditional;
