within Lacuna.Components.Mechanics;
model ViscousFriction "Viscous friction of a shaft in its housing"
  extends Interfaces.Rigid;
  parameter Types.RotationalDamping b(final min=0, start=1e-5) "Friction constant";
  Types.Torque tau "Friction torque against the speed";
  Types.Power loss "Heat";
equation
  tau = b*w;
  flange_a.tau + flange_b.tau = tau;
  loss = tau*w;
  annotation(Documentation(info="<html>
<p>Law: <code>tau = b w</code>, taken from whatever passes between the flanges. The housing takes the reaction.</p>
</html>"));
end ViscousFriction;
