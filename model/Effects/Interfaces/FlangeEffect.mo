within Lacuna.Effects.Interfaces;
partial model FlangeEffect "Torque on a shaft that depends on its motion"
  Lacuna.Interfaces.Flange_a flange "Where it acts";
  Types.Angle angle "Angle of the shaft";
  Types.AngularVelocity w "Speed of the shaft";
  Types.Torque tau "Torque taken from the shaft";
equation
  angle = flange.phi;
  w = der(flange.phi);
  flange.tau = tau;
end FlangeEffect;
