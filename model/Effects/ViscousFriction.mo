within Lacuna.Effects;
model ViscousFriction "Friction proportional to speed"
  extends Interfaces.FlangeEffect;
  parameter Types.RotationalDamping b = 0 "Friction constant";
equation
  tau = b*w;
  annotation(__Lacuna(effect="friction.viscous", attaches="flange", neutral(b=0),
    signature="effort proportional to speed, through the origin",
    excitation="two steady speeds", reference="Armstrong-Helouvry 1991, chapter 2"));
end ViscousFriction;
