// section: 15.2
// value: b.h_in = 5
model StreamUnconnected
  connector Port
    Real p;
    flow Real m;
    stream Real h;
  end Port;
  model Sink
    Port port;
    Real h_in = inStream(port.h);
  equation
    port.p = 1;
    port.h = 5;
  end Sink;
  Sink b;
end StreamUnconnected;
