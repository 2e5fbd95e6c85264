within Lacuna.Effects;
model ImposedStribeck "Dry friction of a device that falls from breakaway to sliding"
  extends Lacuna.Interfaces.ImposedMotion;
  parameter Types.Force F_c(final min=0) = 0 "Level at high speed";
  parameter Types.Force F_s(final min=0) = 0 "Level at low speed";
  parameter Types.Velocity v_s(final min=1e-9) = 0.01 "Stribeck speed";
  Types.Force level "Level at the present speed";
equation
  level = F_c + (F_s - F_c)*exp(-(v/v_s)*(v/v_s));
  f = noEvent(if v > 0 then level elseif v < 0 then -level else 0);
  annotation(__Lacuna(effect="friction.stribeck", attaches="imposed", neutral(F_c=0, F_s=0), starts(v_s={0.02, 0.1, 0.4}), relative(v_s="v"),
    signature="force with the sign of the speed that falls within the first part of the speed range", excitation="slow and fast reversals", reference="Olsson, Astrom, Canudas de Wit, Gafvert, Lischinsky 1998"));
end ImposedStribeck;
