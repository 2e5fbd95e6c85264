// section: 9.4.2
// refuse: R080 19
model OverconstrainedTwoRoots
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
    Angle angle;
  end Port;
  Port p, n;
equation
  Connections.root(p.angle);
  Connections.root(n.angle);
  Connections.branch(p.angle, n.angle);
  p.angle = n.angle;
  p.angle = 3;
end OverconstrainedTwoRoots;
