// section: 15.2
// value: b.h = 30, b.ha = 30
connector S
  Real p;
  flow Real m;
  stream Real h;
end S;
model Src
  S port;
  parameter Real h0;
  parameter Real m0;
equation
  port.m = -m0;
  port.h = h0;
end Src;
model Snk
  S port;
  Real h = inStream(port.h);
  Real ha = actualStream(port.h);
equation
  port.p = 2;
  port.h = 9;
end Snk;
model MixedStreams
  Src a(h0 = 10, m0 = 1);
  Src c(h0 = 40, m0 = 2);
  Snk b;
equation
  connect(a.port, b.port);
  connect(c.port, b.port);
end MixedStreams;
