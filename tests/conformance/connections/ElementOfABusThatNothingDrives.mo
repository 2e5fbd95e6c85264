// section: 9.1.3
// refuse: R077 26
model ElementOfABusThatNothingDrives "one component brings the first of two elements that are read"
  connector In = input Real;
  connector Out = output Real;
  expandable connector Bus
  end Bus;
  block Constant
    Out y = 1;
  end Constant;
  model Sensor
    Bus bus;
    Constant c;
  equation
    connect(c.y, bus.u[1]);
  end Sensor;
  block Sum
    In u1, u2;
    Out y = u1 + u2;
  end Sum;
  Bus bus;
  Sensor a;
  Sum sum;
equation
  connect(bus.u[1], sum.u1);
  connect(bus.u[2], sum.u2);
  connect(a.bus, bus);
end ElementOfABusThatNothingDrives;
