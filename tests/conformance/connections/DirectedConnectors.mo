// section: 9.3.1
// value: x.c.f = 3, y.c.f = -3
connector FA
  input Real r;
  Real a;
  flow Real f;
end FA;
connector FB
  output Real r;
  Real a;
  flow Real f;
end FB;
model A
  FA c;
equation
  c.f = c.a - c.r;
end A;
model B
  FB c;
equation
  c.r = 4;
  c.a = 7;
end B;
model DirectedConnectors
  A x;
  B y;
equation
  connect(x.c, y.c);
end DirectedConnectors;
