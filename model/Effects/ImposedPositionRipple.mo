within Lacuna.Effects;
model ImposedPositionRipple "Dry friction of a device that varies periodically along the stroke"
  extends Lacuna.Interfaces.ImposedMotion;
  parameter Types.Force F_c(final min=0) = 0 "Mean level";
  parameter Types.Force amplitude(final min=0) = 0 "Amplitude of the level";
  parameter Types.Length period(final min=1e-9) = 0.01 "Length of a period";
  parameter Types.Angle phase = 0 "Phase at position zero";
  constant Real pi = 3.141592653589793;
  Types.Force level "Level at the present position";
equation
  level = noEvent(max(F_c + amplitude*sin(2*pi*s/period + phase), 0));
  f = noEvent(if v > 0 then level elseif v < 0 then -level else 0);
  annotation(__Lacuna(effect="friction.position", attaches="imposed", neutral(F_c=0, amplitude=0), polar={"amplitude", "phase"}, starts(period={0.3, 0.5, 0.8, 1.3, 2, 4}), relative(period="s"),
    signature="force with the sign of the speed whose size follows the position", excitation="reversals over the whole stroke", reference="Olsson, Astrom, Canudas de Wit, Gafvert, Lischinsky 1998"));
end ImposedPositionRipple;
