within Lacuna.Components.Mechanics;
model DryFriction "Dry friction of a shaft in its housing"
  extends Interfaces.TwoFlanges;
  extends Interfaces.PartialFriction;
  parameter Types.Torque tau_c(final min=0, start=1e-3) "Sliding friction";
  parameter Types.PerUnit peak(final min=1) = 1 "Breakaway level over sliding level";
  Types.Angle phi "Angle of the shaft";
equation
  flange_a.phi = phi;
  flange_b.phi = phi;
  w_fric = der(phi);
  flange_a.tau + flange_b.tau = tau_fric;
  tau_slide = tau_c;
  tau_break = peak*tau_slide;
  annotation(Documentation(info="<html>
<p>Law: <code>tau_c</code> against the motion, <code>peak</code> times as much before it moves. <code>tau_c = 0</code> is no
friction.</p>
</html>"));
end DryFriction;
