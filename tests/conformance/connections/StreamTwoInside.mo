// section: 15.2
// value: b.h_in = 3
model StreamTwoInside
  connector Port
    Real p;
    flow Real m;
    stream Real h;
  end Port;
  model Source
    Port port;
  equation
    port.p = 1;
    port.h = 3;
  end Source;
  model Sink
    Port port;
    Real h_in = inStream(port.h);
  equation
    port.m = 1;
    port.h = 0;
  end Sink;
  Source a;
  Sink b;
equation
  connect(a.port, b.port);
end StreamTwoInside;
