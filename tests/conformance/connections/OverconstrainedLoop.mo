// section: 9.4
// value: a.p.angle = 0.5, c.n.angle = 0.5, c.p.angle = 0.5
model OverconstrainedLoop "three parts in a ring: one connection is broken"
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
  model Part
    Port p, n;
  equation
    Connections.branch(p.angle, n.angle);
    p.angle = n.angle;
    p.i + n.i = 0;
    p.v - n.v = p.i;
  end Part;
  model Source
    Port p;
  equation
    Connections.potentialRoot(p.angle);
    if Connections.isRoot(p.angle) then
      p.angle = 0.5*time;
    end if;
    p.v = 1;
  end Source;
  Part a, b, c;
  Source s;
equation
  connect(s.p, a.p);
  connect(a.n, b.p);
  connect(b.n, c.p);
  connect(c.n, a.p);
end OverconstrainedLoop;
