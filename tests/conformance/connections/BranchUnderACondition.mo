// section: 8.3.3
// refuse: F031 19
model BranchUnderACondition
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
  if time > 0.5 then
    Connections.branch(p.angle, n.angle);
  end if;
  p.angle = n.angle;
  p.angle = 3;
end BranchUnderACondition;
