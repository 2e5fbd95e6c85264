// section: 9.1.3
// value: b.y = 3
model BusOfOneSignal
  expandable connector Bus
  end Bus;
  connector In = input Real;
  connector Out = output Real;
  block Src
    Out y = 3;
  end Src;
  block Snk
    In u;
    Real y = u;
  end Snk;
  Bus bus;
  Src a;
  Snk b;
equation
  connect(a.y, bus.speed);
  connect(bus.speed, b.u);
end BusOfOneSignal;
