within Lacuna.Effects;
model ImposedPosition "Dry friction of a device that varies along the stroke"
  extends Lacuna.Interfaces.ImposedMotion;
  parameter Types.Force F_c(final min=0) = 0 "Level at position zero";
  parameter Real slope(unit="N/m") = 0 "Growth of the level with position";
  parameter Real curvature(unit="N/m2") = 0 "Growth of the slope with position";
  Types.Force level "Level at the present position";
equation
  level = noEvent(max(F_c + slope*s + curvature*s*s, 0));
  f = noEvent(if v > 0 then level elseif v < 0 then -level else 0);
  annotation(__Lacuna(effect="friction.position", attaches="imposed", neutral(F_c=0, slope=0, curvature=0),
    signature="force with the sign of the speed whose size follows the position", excitation="reversals over the whole stroke", reference="Olsson, Astrom, Canudas de Wit, Gafvert, Lischinsky 1998"));
end ImposedPosition;
