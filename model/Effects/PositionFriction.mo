within Lacuna.Effects;
model PositionFriction "Dry friction that varies along the stroke"
  extends Interfaces.FrictionEffect;
  parameter Types.Torque tau_c(final min=0) = 0 "Level at position zero";
  parameter Types.RotationalStiffness slope = 0 "Growth of the level with position";
  parameter Real curvature(unit="N.m/rad2") = 0 "Growth of the slope with position";
  constant Types.Angle longest = 2000 "Angle beyond which a shaft is no stroke: some hundred turns";
equation
  assert(noEvent(abs(angle) < longest), "PositionFriction: a shaft that turns on and on has no stroke");
  flange.tau = tau_fric;
  tau_slide = noEvent(max(tau_c + slope*angle + curvature*angle*angle, 0));
  tau_break = tau_slide;
  annotation(__Lacuna(effect="friction.position", attaches="flange", neutral(tau_c=0, slope=0, curvature=0),
    signature="effort with the sign of the speed whose size follows the position",
    excitation="reversals over the whole stroke", reference="Armstrong-Helouvry 1991, chapter 4"));
end PositionFriction;
