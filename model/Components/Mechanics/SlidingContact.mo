within Lacuna.Components.Mechanics;
model SlidingContact "Dry friction between two turning bodies"
  extends Interfaces.TwoFlanges;
  extends Interfaces.PartialFriction;
  parameter Types.Torque tau_c(final min=0, start=1e-3) "Sliding friction";
  parameter Types.PerUnit peak(final min=1) = 1 "Breakaway level over sliding level";
  Types.Angle phi_rel(stateSelect=StateSelect.prefer) "Angle of flange_b relative to flange_a";
equation
  phi_rel = flange_b.phi - flange_a.phi;
  w_fric = der(phi_rel);
  flange_b.tau = tau_fric;
  flange_a.tau = -tau_fric;
  tau_slide = tau_c;
  tau_break = peak*tau_c;
  annotation(Documentation(info="<html>
<p>A belt under a mass, a brake, a slipping clutch. While stuck the two bodies turn as one.</p>
</html>"));
end SlidingContact;
