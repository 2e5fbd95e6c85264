// section: 9.1.3
// value: u.y = 3, p.y = 3
model BusInABus "expandable buses nested two deep"
  expandable connector Inner
  end Inner;
  expandable connector Bus
    Inner sub;
  end Bus;
  connector RealOut = output Real;
  connector RealIn = input Real;
  block Src
    RealOut y = 3*time;
  end Src;
  block Use
    RealIn u;
    Real y = u;
  end Use;
  model Plant
    Bus bus;
    Src s;
  equation
    connect(s.y, bus.sub.speed);
  end Plant;
  model Ctl
    Bus bus;
    Use u;
    Real y = u.y;
  equation
    connect(bus.sub.speed, u.u);
  end Ctl;
  Bus bus;
  Plant plant;
  Ctl u;
  Ctl p;
equation
  connect(plant.bus, bus);
  connect(bus, u.bus);
  connect(bus, p.bus);
end BusInABus;
