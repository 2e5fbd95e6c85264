// section: 9.1.3
// value: t = 9
model ExpandableArray
  connector RealInput = input Real;
  connector RealOutput = output Real;
  expandable connector Bus
  end Bus;
  block Source
    parameter Real k = 1;
    RealOutput y = k;
  end Source;
  block Sink
    RealInput u[2];
  end Sink;
  Bus bus;
  Source a(k=4), b(k=5);
  Sink sink;
  Real t = sum(sink.u);
equation
  connect(a.y, bus.v[1]);
  connect(b.y, bus.v[2]);
  connect(bus.v, sink.u);
end ExpandableArray;
