// section: 9.1.3
// value: sink.y = 7, bus.speed = 7
model Expandable
  connector RealInput = input Real;
  connector RealOutput = output Real;
  expandable connector Bus
  end Bus;
  block Source
    RealOutput y = 7;
  end Source;
  block Sink
    RealInput u;
    Real y = u;
  end Sink;
  Bus bus;
  Source source;
  Sink sink;
equation
  connect(source.y, bus.speed);
  connect(bus.speed, sink.u);
end Expandable;
