within Lacuna.Components.Mechanics;
model EndStops "Mechanical limits of the travel of a shaft"
  extends Interfaces.Rigid;
  parameter Types.Angle phi_max(start=0.5) "Upper limit";
  parameter Types.Angle phi_min = -phi_max "Lower limit";
  parameter Types.RotationalStiffness c(final min=0, start=1e5) "Stiffness of a stop";
  parameter Types.ContactDamping lambda(final min=0) = 1 "Loss factor of a stop";
  Types.Torque tau "Torque of the stop that is touched, against the angle";
  Types.Power loss "Heat";
  Types.Energy stored "Elastic energy";
  Integer side(start=0) "Stop that is touched: 1 upper, -1 lower; 0 none";
protected
  Types.Angle depth "Deformation of the stop";
  Types.PerUnit factor "Elastic torque is multiplied by this";
equation
  assert(phi_min < phi_max, "EndStops: phi_min must be below phi_max");
  side = if phi > phi_max then 1 elseif phi < phi_min then -1 else 0;
  depth = if side > 0 then phi - phi_max elseif side < 0 then phi_min - phi else 0;
  factor = 1 + side*lambda*w;
  tau = if factor > 0 then side*c*depth*factor else 0;
  flange_a.tau + flange_b.tau = tau;
  loss = (tau - side*c*depth)*w;
  stored = c*depth*depth/2;
  annotation(Documentation(info="<html>
<p>Contact after Hunt and Crossley: <code>tau = c delta (1 + lambda d|delta|/dt)</code>, never pulling. The torque
begins at
zero whatever the speed of impact, which the law <code>c delta + d w</code> does not, and ends at zero. A share of about
<code>2/3 lambda w</code> of the energy of an impact at speed <code>w</code> is lost in each half when <code>lambda
w</code>
is small.</p>
<p>Reference: K. H. Hunt, F. R. E. Crossley: Coefficient of restitution interpreted as damping in vibroimpact, J. Appl.
Mech. 42 (1975) 440-445.</p>
</html>"));
end EndStops;
