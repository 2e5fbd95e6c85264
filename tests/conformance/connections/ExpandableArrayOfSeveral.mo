// section: 9.1.3
// value: s = 21, n = 21
model ExpandableArrayOfSeveral "components bring elements of one array to a bus, and of one in a bus within it"
  connector RealInput = input Real;
  connector RealOutput = output Real;
  expandable connector Inside
  end Inside;
  expandable connector Bus
    Inside inside;
  end Bus;
  block Source
    parameter Real k = 1;
    RealOutput y = k;
  end Source;
  model Unit
    parameter Integer id = 1;
    Bus bus;
    Source c(k = 10*id), d(k = 10*id);
  equation
    connect(c.y, bus.u[id]);
    connect(d.y, bus.inside.v[id]);
  end Unit;
  block Sink
    RealInput u;
  end Sink;
  Bus bus;
  Unit a(id = 1), b(id = 2, c(k = 11), d(k = 11));
  Sink first, second, third, fourth;
  Real s = first.u + second.u, n = third.u + fourth.u;
equation
  connect(a.bus, bus);
  connect(b.bus, bus);
  connect(bus.u[1], first.u);
  connect(bus.u[2], second.u);
  connect(bus.inside.v[1], third.u);
  connect(bus.inside.v[2], fourth.u);
end ExpandableArrayOfSeveral;
