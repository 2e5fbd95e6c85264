within Lacuna.Components.Mechanics;
model DryFriction "Dry friction of a shaft in its housing, constant or growing with the load"
  extends Interfaces.TwoFlanges;
  extends Interfaces.PartialFriction;
  parameter Types.Torque tau_c(final min=0, start=1e-3) "Sliding friction without load";
  parameter Types.PerUnit peak(final min=1) = 1 "Breakaway level over sliding level";
  parameter Types.PerUnit mu(final min=0) = 0 "Share of the transmitted torque that is added to the friction";
  Types.Angle phi "Angle of the shaft";
equation
  flange_a.phi = phi;
  flange_b.phi = phi;
  w_fric = der(phi);
  flange_a.tau + flange_b.tau = tau_fric;
  tau_slide = tau_c + mu*noEvent(abs(flange_b.tau));
  tau_break = peak*tau_slide;
  annotation(Documentation(info="<html>
<p>Law: <code>tau_c + mu |flange_b.tau|</code> against the motion, <code>peak</code> times as much before it moves.
With the
load on <code>flange_b</code> the second term is the friction of meshing teeth or of a loaded screw: efficiency
<code>1 - mu</code> when driving. <code>tau_c = 0, mu = 0</code> is no friction.</p>
</html>"));
end DryFriction;
