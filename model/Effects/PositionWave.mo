within Lacuna.Effects;
model PositionWave "Dry friction that rises and falls along the stroke"
  extends Interfaces.FrictionEffect;
  parameter Types.Torque tau_c(final min=0) = 0 "Mean level";
  parameter Types.Torque amplitude(final min=0) = 0 "Amplitude of the level";
  parameter Types.Angle period(final min=1e-6) = 1 "Angle of a period";
  parameter Types.Angle phase = 0 "Phase at angle zero";
  constant Types.Angle longest = 2000 "Angle beyond which a shaft is no stroke: some hundred turns";
  constant Real pi = 3.141592653589793;
equation
  assert(noEvent(abs(angle) < longest), "PositionWave: a shaft that turns on and on has no stroke");
  flange.tau = tau_fric;
  tau_slide = noEvent(max(tau_c + amplitude*sin(2*pi*angle/period + phase), 0));
  tau_break = tau_slide;
  annotation(__Lacuna(effect="friction.position", attaches="flange", neutral(tau_c=0, amplitude=0),
    polar={"amplitude", "phase"}, starts(period={0.4, 0.8, 1.6, 3.2}), relative(period="angle"),
    signature="effort with the sign of the speed whose size follows the position",
    excitation="reversals over the whole stroke", reference="Armstrong-Helouvry 1991, chapter 4"));
end PositionWave;
