within Lacuna.Components.Sensors;
model AngleSensor "Ideal sensor of the angle of a flange"
  Interfaces.Flange_a flange "Flange whose angle is measured";
  Interfaces.RealOutput phi(unit="rad") "Angle";
equation
  flange.tau = 0;
  phi = flange.phi;
end AngleSensor;
