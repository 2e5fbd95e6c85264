within Lacuna.Effects.Interfaces;
partial model SplitInertia "Part of a shaft's inertia that is not rigid with it"
  extends FlangeEffect;
  Lacuna.Interfaces.RealInput J(unit="kg.m2") "Inertia of the whole shaft";
  parameter Types.PerUnit share(final min=0.02, final max=0.98) = 0.5 "Part of it behind the element";
  Types.Angle phi_b "Angle of that part";
  Types.AngularVelocity w_b "Speed of that part";
  Types.Angle phi_rel "Angle of the shaft ahead of that part";
  Types.AngularVelocity w_rel "Its derivative";
  Types.Torque tau_b "Torque that reaches that part";
initial equation
  phi_b = angle;
  w_b = w;
equation
  phi_rel = angle - phi_b;
  w_rel = w - w_b;
  der(phi_b) = w_b;
  share*J*der(w_b) = tau_b;
  tau = tau_b - share*J*der(w);
  annotation(Documentation(info="<html>
<p>The believed shaft keeps its inertia; the effect takes <code>share*J</code> off it and puts it behind an element that gives
<code>tau_b</code>. So the whole inertia stays what it is believed to be.</p>
</html>"));
end SplitInertia;
