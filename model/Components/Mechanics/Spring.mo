within Lacuna.Components.Mechanics;
model Spring "Linear torsion spring"
  extends Interfaces.Compliant;
  parameter Types.RotationalStiffness c(final min=0, start=1) "Stiffness";
  parameter Types.Angle phi_rel0 = 0 "Relative angle without torque";
equation
  tau = c*(phi_rel - phi_rel0);
  annotation(Documentation(info="<html>
<p>Law: <code>tau = c (phi_rel - phi_rel0)</code>; it stores <code>tau^2/(2 c)</code>.</p>
</html>"));
end Spring;
