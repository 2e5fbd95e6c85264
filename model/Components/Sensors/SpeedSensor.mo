within Lacuna.Components.Sensors;
model SpeedSensor "Ideal sensor of the speed of a flange"
  Interfaces.Flange_a flange "Flange whose speed is measured";
  Interfaces.RealOutput w(unit="rad/s") "Speed";
equation
  flange.tau = 0;
  w = der(flange.phi);
end SpeedSensor;
