// section: 15.3
// value: b.h_now = 3, a.h_now = 3
model ActualStream
  connector Port
    Real p;
    flow Real m;
    stream Real h;
  end Port;
  model Source
    Port port;
    Real h_now = actualStream(port.h);
  equation
    port.p = 1;
    port.h = 3;
  end Source;
  model Sink
    Port port;
    Real h_now = actualStream(port.h);
  equation
    port.m = 1;
    port.h = 5;
  end Sink;
  Source a;
  Sink b;
equation
  connect(a.port, b.port);
end ActualStream;
