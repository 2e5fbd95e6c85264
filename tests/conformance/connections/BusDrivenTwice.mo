// section: 9.1.3
// refuse: R077 27
model BusDrivenTwice "two components drive one signal"
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
  Sensor a, b;
  Same sum;
equation
  connect(bus.x, sum.u);
  connect(a.bus, bus);
  connect(b.bus, bus);
end BusDrivenTwice;
