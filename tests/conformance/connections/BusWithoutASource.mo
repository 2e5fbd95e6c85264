// section: 9.1.3
// refuse: R077 15
model BusWithoutASource "Inputs alone are connected to a signal of the bus"
  expandable connector Bus
  end Bus;
  connector RealInput = input Real;
  block Display
    RealInput u;
    Real shown = u;
  end Display;
  Bus bus;
  Display a;
  Display b;
equation
  connect(bus.x, b.u);
  connect(bus.x, a.u);
end BusWithoutASource;
