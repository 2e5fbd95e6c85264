within Lacuna.Effects;
model ImposedQuadratic "Resistance of a device growing with the square of speed"
  extends Lacuna.Interfaces.ImposedMotion;
  parameter Real c2(unit="N.s2/m2") = 0 "Force over the square of speed";
equation
  f = c2*v*noEvent(abs(v));
  annotation(__Lacuna(effect="drag.quadratic", attaches="imposed", neutral(c2=0),
    signature="force against the motion that grows faster than speed", excitation="three speeds", reference="Olsson, Astrom, Canudas de Wit, Gafvert, Lischinsky 1998"));
end ImposedQuadratic;
