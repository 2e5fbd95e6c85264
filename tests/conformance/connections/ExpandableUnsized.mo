// section: 9.1.3
// value: s = 6
model ExpandableUnsized
  expandable connector EC
    Real x[:];
  end EC;
  connector RealInput = input Real;
  connector RealOutput = output Real;
  block Src
    RealOutput y[3] = {1, 2, 3};
  end Src;
  block Snk
    RealInput u[3];
    Real s = sum(u);
  end Snk;
  EC ec;
  Src a;
  Snk b;
  Real s = b.s;
equation
  connect(a.y, ec.x);
  connect(ec.x, b.u);
end ExpandableUnsized;
