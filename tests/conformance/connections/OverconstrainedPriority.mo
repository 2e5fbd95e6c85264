// section: 9.4.1
// value: b.chosen = 1, a.chosen = 0
model OverconstrainedPriority "the potential root with the lowest priority number"
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
    p.v = time + (if chosen then 0 else p.i);
  end Source;
  Source a(priority=3), b(priority=1);
equation
  connect(a.p, b.p);
end OverconstrainedPriority;
