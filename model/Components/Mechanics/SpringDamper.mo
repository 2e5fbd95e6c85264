within Lacuna.Components.Mechanics;
model SpringDamper "Linear spring and damper in parallel"
  extends Interfaces.CompliantWithSpeed;
  parameter Types.RotationalStiffness c(final min=0, start=1) "Stiffness";
  parameter Types.RotationalDamping d(final min=0, start=0) "Damping constant";
  parameter Types.Angle phi_rel0 = 0 "Relative angle without torque";
  Types.Power loss "Heat";
  Types.Energy stored "Elastic energy";
equation
  tau = c*(phi_rel - phi_rel0) + d*w_rel;
  loss = d*w_rel*w_rel;
  stored = c*(phi_rel - phi_rel0)*(phi_rel - phi_rel0)/2;
  annotation(Documentation(info="<html>
<p>Law: <code>tau = c (phi_rel - phi_rel0) + d w_rel</code>, the usual model of an elastic transmission.</p>
</html>"));
end SpringDamper;
