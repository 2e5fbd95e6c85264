// section: 15.2
// value: c.h_in = 2.5
model StreamMixed
  connector Port
    Real p;
    flow Real m;
    stream Real h;
  end Port;
  model Source
    parameter Real h = 1, m = 1;
    Port port;
  equation
    port.m = -m;
    port.h = h;
  end Source;
  model Sink
    Port port;
    Real h_in = inStream(port.h);
  equation
    port.p = 1;
    port.h = 0;
  end Sink;
  Source a(h=1, m=1), b(h=3, m=3);
  Sink c;
equation
  connect(a.port, c.port);
  connect(b.port, c.port);
end StreamMixed;
