// section: 9.1.3
// value: sink.y = 7
model ExpandableThroughTwo
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
  model Station
    Bus bus;
    Source source;
  equation
    connect(source.y, bus.speed);
  end Station;
  Station station;
  Bus bus;
  Sink sink;
equation
  connect(station.bus, bus);
  connect(bus.speed, sink.u);
end ExpandableThroughTwo;
