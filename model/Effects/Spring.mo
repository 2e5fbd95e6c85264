within Lacuna.Effects;
model Spring "Spring to ground, such as an aerodynamic hinge moment"
  extends Interfaces.FlangeEffect;
  parameter Types.RotationalStiffness c = 0 "Stiffness";
  parameter Types.Torque tau_0 = 0 "Torque at position zero";
  constant Types.Angle longest = 2000 "Angle beyond which a shaft has no stroke: a screw has some hundred turns";
equation
  assert(noEvent(abs(angle) < longest), "Spring: a shaft that turns on and on has no spring");
  tau = c*angle + tau_0;
  annotation(__Lacuna(effect="stiffness", attaches="flange", neutral(c=0, tau_0=0),
    signature="effort proportional to position", excitation="steady positions apart from each other",
    reference="Roskam 2001, hinge moments"));
end Spring;
