// section: 9.1.3
// value: x.p.i = 2, y.p.i = 2, b.bus.p[1].i = 0, a.bus.q.i = 0, z.p.v = 6
model PinsOfABusByTwo "what others bring to a bus passes by: no current of it flows into a component that does not use it"
  connector Pin
    Real v(unit="V");
    flow Real i(unit="A");
  end Pin;
  expandable connector Bus
  end Bus;
  model Cell "behind 1 Ohm"
    Pin p;
    parameter Real E(unit="V");
    parameter Real R(unit="Ohm") = 1;
  equation
    p.v = E + R*p.i;
  end Cell;
  model Source
    Bus bus;
    parameter Integer at;
    parameter Real E(unit="V");
    Cell cell(E=E);
  equation
    connect(cell.p, bus.p[at]);
  end Source;
  model Other
    Bus bus;
    Cell cell(E=6);
  equation
    connect(cell.p, bus.q);
  end Other;
  model Load
    Pin p;
    parameter Real R(unit="Ohm");
  equation
    p.v = R*p.i;
  end Load;
  model Meter
    Pin p;
  equation
    p.i = 0;
  end Meter;
  Bus bus;
  Source a(at=1, E=10), b(at=2, E=20);
  Other c;
  Load x(R=4), y(R=9);
  Meter z;
equation
  connect(a.bus, bus);
  connect(b.bus, bus);
  connect(c.bus, bus);
  connect(bus.p[1], x.p);
  connect(bus.p[2], y.p);
  connect(bus.q, z.p);
end PinsOfABusByTwo;
