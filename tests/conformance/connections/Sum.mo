// section: 9.2
// value: f = 3
model Sum
  connector C
    Real e;
    flow Real f;
  end C;
  model Source
    parameter Real f = 1;
    C c;
  equation
    c.f = -f;
  end Source;
  model Sink
    C c;
  equation
    c.e = 2;
  end Sink;
  Source a(f=1), b(f=2);
  Sink s;
  Real f = s.c.f;
equation
  connect(a.c, s.c);
  connect(b.c, s.c);
end Sum;
