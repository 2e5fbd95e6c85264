// section: 15.2
// value: o.i.hin = 5, o.port.h = 7
connector S
  Real p;
  flow Real m;
  stream Real h;
end S;
model Outer
  S port;
  Inner i;
equation
  connect(port, i.port);
end Outer;
model Inner
  S port;
  Real hin = inStream(port.h);
equation
  port.m = 3;
  port.h = 7;
end Inner;
model Src
  S port;
equation
  port.p = 1;
  port.h = 5;
end Src;
model StreamThroughABoundary
  Outer o;
  Src s;
equation
  connect(s.port, o.port);
end StreamThroughABoundary;
