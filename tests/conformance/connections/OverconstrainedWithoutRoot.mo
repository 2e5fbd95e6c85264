// section: 9.4.2
// refuse: R080 20
model OverconstrainedWithoutRoot
  type Angle
    extends Real;
    function equalityConstraint
      input Angle a;
      input Angle b;
      output Real residue[0];
    algorithm
    end equalityConstraint;
  end Angle;
  connector Port
    Real v;
    flow Real i;
    Angle angle;
  end Port;
  Port p, n;
equation
  Connections.branch(p.angle, n.angle);
  p.angle = n.angle;
  p.v = 1;
  n.v = 2;
  p.angle = 3;
end OverconstrainedWithoutRoot;
