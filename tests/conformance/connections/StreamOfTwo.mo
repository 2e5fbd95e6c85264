// section: 15.2
// value: h = 5
model StreamOfTwo
  connector P
    Real p;
    flow Real m;
    stream Real h;
  end P;
  model S
    P port;
  equation
    port.p = 1;
    port.h = 5;
  end S;
  model T
    P port;
    Real h = inStream(port.h);
  equation
    port.m = 2;
    port.h = 7;
  end T;
  S s;
  T t;
  Real h = t.h;
equation
  connect(s.port, t.port);
end StreamOfTwo;
