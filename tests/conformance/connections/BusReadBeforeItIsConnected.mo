// section: 9.1.3
// value: sum.y = 2
model BusReadBeforeItIsConnected "the order of connections says nothing"
  connector In = input Real;
  connector Out = output Real;
  expandable connector Bus
  end Bus;
  block Constant
    Out y = 2;
  end Constant;
  model Sensor
    Bus bus;
    Constant c;
  equation
    connect(c.y, bus.x);
  end Sensor;
  block Same
    In u;
    Out y = u;
  end Same;
  Bus bus;
  Sensor a;
  Same sum;
equation
  connect(bus.x, sum.u);
  connect(a.bus, bus);
end BusReadBeforeItIsConnected;
