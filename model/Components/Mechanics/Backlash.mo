within Lacuna.Components.Mechanics;
model Backlash "Elastic transmission with play; its contact only pushes"
  extends Interfaces.CompliantWithSpeed;
  parameter Types.RotationalStiffness c(final min=0, start=1e4) "Stiffness in contact";
  parameter Types.RotationalDamping d(final min=0) = 0 "Damping in contact";
  parameter Types.Angle b(final min=0) = 0 "Total play";
  parameter Types.Angle b_min(final min=0) = 1e-10 "Play below which it is a spring and damper";
  Types.Power loss "Heat";
  Types.Energy stored "Elastic energy";
  Integer side(start=0) "Flank in contact: 1 or -1; 0 none";
protected
  parameter Types.Angle reach = if b < b_min then 1e6 else b/2 "Half of the play; never reached where there is none";
  Types.Angle delta "Deformation";
  Types.Torque tau_c "Elastic torque";
  Types.Torque tau_d "Damping torque before its limit, positive where the flanks approach";
  Types.Torque push "Torque of the flanks on each other, not negative";
equation
  side = if phi_rel > reach then 1 elseif phi_rel < -reach then -1 else 0;
  delta = if b < b_min then phi_rel elseif side > 0 then phi_rel - reach elseif side < 0 then phi_rel + reach else 0;
  tau_c = c*delta;
  tau_d = side*d*w_rel;
  push = if tau_d > side*tau_c then 2*side*tau_c elseif tau_d < -side*tau_c then 0 else side*tau_c + tau_d;
  tau = if b < b_min then tau_c + d*w_rel else side*push;
  loss = (tau - tau_c)*w_rel;
  stored = tau_c*delta/2;
  annotation(Documentation(info="<html>
<p>Within the play no torque passes. In contact, <code>tau = c delta + d w_rel</code> with the damping part limited to
<code>|c delta|</code>.</p>
<p>Why the limit: the plain sum pulls teeth together when they part quickly, and jumps when they meet at speed. With
it the
torque keeps the sign of the deformation, lies between zero and twice the elastic one, and begins at zero. Limit case:
with <code>b = 0</code> teeth never part and it is the linear spring and damper.</p>
<p>While the flanks touch, the law goes on smoothly beyond the instant at which they part. A bound at zero there would be
a corner at the end of the step in which that instant is looked for, and cost a method its order.</p>
<p>Reference: Modelica Standard Library, Rotational.Components.ElastoBacklash.</p>
</html>"));
end Backlash;
