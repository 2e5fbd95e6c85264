within Lacuna.Components.Mechanics;
model LoadFriction "Dry friction of a shaft in its housing that grows with the load"
  extends Interfaces.TwoFlanges;
  extends Interfaces.PartialFriction;
  parameter Types.Torque tau_c(final min=0, start=1e-3) "Sliding friction without load";
  parameter Types.PerUnit mu(final min=0, start=0.05) "Share of the transmitted torque that is added to the friction";
  parameter Types.PerUnit peak(final min=1) = 1 "Breakaway level over sliding level";
  Types.Angle phi "Angle of the shaft";
equation
  flange_a.phi = phi;
  flange_b.phi = phi;
  w_fric = der(phi);
  flange_a.tau + flange_b.tau = tau_fric;
  tau_slide = tau_c + mu*noEvent(abs(flange_b.tau));
  tau_break = peak*tau_slide;
  annotation(Documentation(info="<html>
<p>Law: <code>tau_c + mu |flange_b.tau|</code> against the motion, <code>peak</code> times as much before it moves. With the
load on <code>flange_b</code> the second term is the friction of meshing teeth or of a loaded screw: driving takes
<code>1 + mu</code> times the load. The corner at zero load is no event: the torque is continuous there. With
<code>mu = 0</code> it is <code>DryFriction</code>.</p>
</html>"));
end LoadFriction;
