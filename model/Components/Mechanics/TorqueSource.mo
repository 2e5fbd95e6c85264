within Lacuna.Components.Mechanics;
model TorqueSource "Torque on a flange, from a signal"
  Interfaces.RealInput u(unit="N.m") "Torque that drives the flange";
  Interfaces.Flange_b flange "Driven flange";
equation
  flange.tau = -u;
  annotation(Documentation(info="<html>
<p>Law: torque <code>u</code> on whatever is connected, positive in the sense of the angle. The housing takes the
reaction.</p>
</html>"));
end TorqueSource;
