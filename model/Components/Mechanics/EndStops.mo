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
protected
  Types.Angle delta "Deformation of the stop that is touched";
  Types.PerUnit push "Damping factor before it is limited";
equation
  assert(phi_min < phi_max, "EndStops: phi_min must be below phi_max");
  delta = if phi > phi_max then phi - phi_max elseif phi < phi_min then phi - phi_min else 0;
  push = if delta > 0 then 1 + lambda*w elseif delta < 0 then 1 - lambda*w else 1;
  tau = if push > 0 then c*delta*push else 0;
  flange_a.tau + flange_b.tau = tau;
  loss = (tau - c*delta)*w;
  stored = c*delta*delta/2;
  annotation(Documentation(info="<html>
<p>Contact after Hunt and Crossley: <code>tau = c delta (1 + lambda d|delta|/dt)</code>, never pulling. The torque begins at
zero whatever the speed of impact, which the law <code>c delta + d w</code> does not, and ends at zero. A share of about
<code>2/3 lambda w</code> of the energy of an impact at speed <code>w</code> is lost in each half when <code>lambda w</code>
is small.</p>
<p>Reference: K. H. Hunt, F. R. E. Crossley: Coefficient of restitution interpreted as damping in vibroimpact, J. Appl.
Mech. 42 (1975) 440-445.</p>
</html>"));
end EndStops;
