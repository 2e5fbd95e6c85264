within Lacuna.Effects;
model ImposedAsymmetric "Dry friction of a device with a different level in each direction"
  extends Lacuna.Interfaces.ImposedMotion;
  parameter Types.Force F_pos(final min=0) = 0 "Level while the speed is positive";
  parameter Types.Force F_neg(final min=0) = 0 "Level while the speed is negative";
equation
  f = noEvent(if v > 0 then F_pos elseif v < 0 then -F_neg else 0);
  annotation(__Lacuna(effect="friction.asymmetric", attaches="imposed", neutral(F_pos=0, F_neg=0),
    signature="force of constant size with the sign of the speed, larger one way", excitation="reversals", reference="Olsson, Astrom, Canudas de Wit, Gafvert, Lischinsky 1998"));
end ImposedAsymmetric;
