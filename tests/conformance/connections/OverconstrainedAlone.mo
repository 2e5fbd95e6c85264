// section: 9.4.1
// value: a.chosen = 1, b.chosen = 1, b.p.angle = 0.5
model OverconstrainedAlone "A potential root that nothing is connected to is the root of its own tree"
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
  model Source
    parameter Integer priority = 0;
    Port p;
    Boolean chosen = Connections.isRoot(p.angle);
  equation
    Connections.potentialRoot(p.angle, priority);
    if Connections.isRoot(p.angle) then
      p.angle = 0.5*time;
    end if;
    p.v = time;
  end Source;
  Source a, b;
end OverconstrainedAlone;
