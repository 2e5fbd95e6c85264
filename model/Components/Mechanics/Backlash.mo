within Lacuna.Components.Mechanics;
model Backlash "Elastic transmission with play; its contact only pushes"
  extends Interfaces.CompliantWithSpeed;
  parameter Types.RotationalStiffness c(final min=0, start=1e4) "Stiffness in contact";
  parameter Types.RotationalDamping d(final min=0) = 0 "Damping in contact";
  parameter Types.Angle b(final min=0) = 0 "Total play";
  parameter Types.Angle b_min(final min=0) = 1e-10 "Play below which it is a spring and damper";
  Types.Power loss "Heat";
  Types.Energy stored "Elastic energy";
protected
  Types.Angle delta "Deformation of the teeth in contact; zero within the play";
  Types.Torque tau_c "Elastic torque";
  Types.Torque tau_d "Damping torque before its limit";
equation
  delta = if phi_rel > b/2 then phi_rel - b/2 elseif phi_rel < -b/2 then phi_rel + b/2 else 0;
  tau_c = c*delta;
  tau_d = d*w_rel;
  tau = if b < b_min then tau_c + tau_d
    elseif tau_d > abs(tau_c) then tau_c + abs(tau_c)
    elseif tau_d < -abs(tau_c) then tau_c - abs(tau_c)
    else tau_c + tau_d;
  loss = (tau - tau_c)*w_rel;
  stored = tau_c*delta/2;
  annotation(Documentation(info="<html>
<p>Within the play no torque passes. In contact, <code>tau = c delta + d w_rel</code> with the damping part limited to
<code>|c delta|</code>.</p>
<p>Why the limit: the plain sum pulls teeth together when they part quickly, and jumps when they meet at speed. With it the
torque keeps the sign of the deformation, lies between zero and twice the elastic one, and begins at zero. Limit case:
with <code>b = 0</code> teeth never part and it is the linear spring and damper.</p>
<p>Reference: Modelica Standard Library, Rotational.Components.ElastoBacklash.</p>
</html>"));
end Backlash;
