// section: 9.1.3
// value: y = 3, z = 3
model InputOfASubmodelOnItsBus
  connector RealInput = input Real;
  connector RealOutput = output Real;
  expandable connector EC
  end EC;
  model Sub
    RealInput u;
    EC bus;
  equation
    connect(u, bus.x);
  end Sub;
  block Src
    RealOutput y = 3;
  end Src;
  model Reader
    EC bus;
    RealOutput y;
  equation
    connect(bus.x, y);
  end Reader;
  Sub s;
  Src a;
  Reader r;
  Real y = r.y;
  Real z = r.y;
equation
  connect(a.y, s.u);
  connect(s.bus, r.bus);
end InputOfASubmodelOnItsBus;
