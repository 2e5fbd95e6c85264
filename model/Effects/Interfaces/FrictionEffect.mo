within Lacuna.Effects.Interfaces;
partial model FrictionEffect "Dry friction of a shaft in its housing, which truly sticks"
  extends Lacuna.Interfaces.PartialFriction;
  Lacuna.Interfaces.Flange_a flange "Where it acts";
  Types.Angle angle "Angle of the shaft";
  Types.AngularVelocity w "Speed of the shaft";
equation
  angle = flange.phi;
  w_fric = der(flange.phi);
  w = w_fric;
end FrictionEffect;
