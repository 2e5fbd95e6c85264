// section: 9.1.3
// value: s.y = 3
model ExpandableInside
  expandable connector Sub
  end Sub;
  expandable connector Bus
    Sub sub;
  end Bus;
  connector I = input Real;
  connector O = output Real;
  block A
    O y = 3;
  end A;
  block B
    I u;
    Real y = u;
  end B;
  Bus bus;
  A a; B s;
equation
  connect(a.y, bus.sub.speed);
  connect(bus.sub.speed, s.u);
end ExpandableInside;
