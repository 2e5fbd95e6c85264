// section: 4.4.5
// value: t.z at 1 = 3
model AbsentOnABus "connections of components that are not there go with them, those to a bus as well"
  expandable connector Bus
  end Bus;
  connector RealInput = input Real;
  connector RealOutput = output Real;
  block Source
    RealOutput y = 3*time;
  end Source;
  block Sink
    RealInput u;
    Real z = u;
  end Sink;
  parameter Boolean more = false;
  Bus bus;
  Source s;
  Sink t;
  Source x if more;
  Sink tx if more;
equation
  connect(s.y, bus.v);
  connect(bus.v, t.u);
  connect(x.y, bus.w);
  connect(bus.w, tx.u);
end AbsentOnABus;
