// section: 15.2
// value: mix.h at 0.25 = 6, mix.h at 0.75 = 20
model StreamsOfFour "three stream connectors with one that reverses"
  connector P
    Real p;
    flow Real m;
    stream Real h;
  end P;
  model F
    P port;
    parameter Real h0 = 1;
    Real m;
  equation
    port.m = m;
    port.h = h0;
  end F;
  model Vol
    P port;
    Real h = inStream(port.h);
  equation
    port.p = 1;
    port.h = 50;
  end Vol;
  F a(h0 = 4, m = -1);
  F b(h0 = 8, m = if time < 0.5 then -1 else 0.5);
  F c(h0 = 100, m = if time < 0.5 then 0 else -0.2);
  Vol mix;
equation
  connect(a.port, b.port);
  connect(b.port, c.port);
  connect(c.port, mix.port);
end StreamsOfFour;
