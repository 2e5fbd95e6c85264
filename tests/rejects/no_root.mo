// code: R080
// line: 17
// hint: Connections.root
model M
  type Angle
    extends Real;
    function equalityConstraint
      input Angle a;
      input Angle b;
      output Real residue[0];
    algorithm
    end equalityConstraint;
  end Angle;
  connector Port Angle angle; end Port;
  Port p, n;
equation
  Connections.branch(p.angle, n.angle);
  p.angle = n.angle;
  p.angle = 3;
end M;
