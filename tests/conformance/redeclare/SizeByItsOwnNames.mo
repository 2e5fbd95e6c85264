// section: 7.3
// value: s.y[1] = 2, s.y[2] = 2, s.total = 4
model SizeByItsOwnNames "sizes are kept, and mean what they meant where they are written"
  partial block Base
    parameter Real k = 1;
    Real y;
  end Base;
  block Gain
    extends Base;
  equation
    y = k;
  end Gain;
  block Twice
    extends Base;
  equation
    y = 2*k;
  end Twice;
  model S
    parameter Integer n = 2;
    replaceable Gain g[n](k={1, 2}) constrainedby Base;
    Real y[n] = g.y;
    Real total = sum(g.y);
  end S;
  S s(redeclare Twice g);
end SizeByItsOwnNames;
