within Lacuna.Components.Mechanics;
model Gear "Ideal reducer, without loss, play or inertia"
  extends Interfaces.TwoFlanges;
  parameter Types.PerUnit ratio(start=100) "Turns of flange_a for one turn of flange_b; negative: it reverses";
equation
  flange_a.phi = ratio*flange_b.phi;
  0 = ratio*flange_a.tau + flange_b.tau;
  annotation(Documentation(info="<html>
<p>Laws: <code>phi_a = ratio phi_b</code>, <code>tau_b = -ratio tau_a</code>. No power is lost. Inertias on its two
sides
become one: their constraint is differentiated.</p>
</html>"));
end Gear;
