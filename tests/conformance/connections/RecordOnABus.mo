// section: 9.1.3
// value: r.y = 5, s = 2
model RecordOnABus "expandable connector with declared elements and a record, array of inputs"
  record Data
    Real a;
    Real b;
  end Data;
  connector O = output Real;
  connector I = input Real;
  connector DataO = output Data;
  connector DataI = input Data;
  expandable connector Bus
    Real declared "only maybe";
    Integer unused;
  end Bus;
  block S
    O y = 2*time;
    DataO d(a = time, b = 4*time);
  end S;
  block R
    I u;
    DataI d;
    Real y = d.a + d.b;
    Real z = u;
  end R;
  Bus bus;
  S src;
  R r;
  Real s = r.z;
equation
  connect(src.y, bus.declared);
  connect(src.d, bus.d);
  connect(bus.d, r.d);
  connect(bus.declared, r.u);
end RecordOnABus;
