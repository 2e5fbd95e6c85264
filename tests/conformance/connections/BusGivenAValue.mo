// section: 9.1.3
// refuse: R061 9
model BusGivenAValue "What only a connection makes present is not modified"
  connector RealOutput = output Real;
  expandable connector Bus
    Real x;
  end Bus;
  RealOutput y = time;
  Bus bus(x = 1);
equation
  connect(y, bus.x);
end BusGivenAValue;
