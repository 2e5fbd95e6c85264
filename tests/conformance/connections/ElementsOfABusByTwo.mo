// section: 9.1.3
// value: sum.y = 12, bus.inside.u[1] = 10, a.bus.inside.u[2] = 2, b.bus.inside.u[1] = 10
model ElementsOfABusByTwo "each component brings one element of an array that no bus declares"
  connector In = input Real;
  connector Out = output Real;
  expandable connector Nested
  end Nested;
  expandable connector Bus
    Nested inside;
  end Bus;
  block Constant
    parameter Real k;
    Out y = k;
  end Constant;
  model Sensor
    Bus bus;
    parameter Integer at;
    parameter Real k;
    Constant c(k=k);
  equation
    connect(c.y, bus.inside.u[at]);
  end Sensor;
  block Sum
    In u1, u2;
    Out y = u1 + u2;
  end Sum;
  Bus bus;
  Sensor a(at=1, k=10), b(at=2, k=2);
  Sum sum;
equation
  connect(a.bus, bus);
  connect(b.bus, bus);
  connect(bus.inside.u[1], sum.u1);
  connect(bus.inside.u[2], sum.u2);
end ElementsOfABusByTwo;
