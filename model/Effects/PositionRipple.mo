within Lacuna.Effects;
model PositionRipple "Dry friction that varies periodically along the stroke"
  extends Interfaces.FrictionEffect;
  parameter Types.Torque tau_c(final min=0) = 0 "Mean level";
  parameter Types.Torque amplitude(final min=0) = 0 "Amplitude of the level";
  parameter Real periods(final min=0) = 1 "Periods a turn";
  parameter Types.Angle phase = 0 "Phase at angle zero";
equation
  flange.tau = tau_fric;
  tau_slide = noEvent(max(tau_c + amplitude*sin(periods*angle + phase), 0));
  tau_break = tau_slide;
  annotation(__Lacuna(effect="friction.position", attaches="flange", neutral(tau_c=0, amplitude=0),
    polar={"amplitude", "phase"}, whole={"periods"}, starts(periods={1, 2, 3, 4, 6, 8, 12}),
    signature="effort with the sign of the speed whose size follows the position",
    excitation="reversals over the whole stroke", reference="Armstrong-Helouvry 1991, chapter 4"));
end PositionRipple;
