within Lacuna.Effects;
model ImposedCoulomb "Dry friction of a device: constant level against the motion"
  extends Lacuna.Interfaces.ImposedMotion;
  parameter Types.Force F_c(final min=0) = 0 "Level";
equation
  f = noEvent(if v > 0 then F_c elseif v < 0 then -F_c else 0);
  annotation(__Lacuna(effect="friction.coulomb", attaches="imposed", neutral(F_c=0), nests_in={"friction.stribeck", "friction.asymmetric", "friction.position", "friction.presliding"},
    signature="force of constant size with the sign of the speed", excitation="reversals at two amplitudes", reference="Olsson, Astrom, Canudas de Wit, Gafvert, Lischinsky 1998"));
end ImposedCoulomb;
