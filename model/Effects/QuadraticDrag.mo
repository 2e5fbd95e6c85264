within Lacuna.Effects;
model QuadraticDrag "Loss torque growing with the square of speed"
  extends Interfaces.FlangeEffect;
  parameter Real c2(unit="N.m.s2/rad2") = 0 "Torque over the square of speed";
equation
  tau = c2*w*noEvent(abs(w));
  annotation(__Lacuna(effect="drag.quadratic", attaches="flange", neutral(c2=0),
    signature="effort against the motion that grows faster than speed",
    excitation="three steady speeds up to the highest", reference="windage of rotors, Vrancik 1968"));
end QuadraticDrag;
