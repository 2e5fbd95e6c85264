within Lacuna.Components.Mechanics;
model Damper "Linear damper between two flanges"
  extends Interfaces.CompliantWithSpeed;
  parameter Types.RotationalDamping d(final min=0, start=1e-5) "Damping constant";
  Types.Power loss "Heat";
equation
  tau = d*w_rel;
  loss = tau*w_rel;
  annotation(Documentation(info="<html>
<p>Law: <code>tau = d w_rel</code>.</p>
</html>"));
end Damper;
