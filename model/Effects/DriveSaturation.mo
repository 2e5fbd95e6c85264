within Lacuna.Effects;
model DriveSaturation "Source with a limit"
  extends Lacuna.Interfaces.TwoPin;
  Lacuna.Interfaces.RealInput u(unit="V") "Commanded voltage";
  parameter Types.Voltage limit(final min=0) = 1e6 "Greatest output";
equation
  v = noEvent(min(max(u, -limit), limit));
  annotation(__Lacuna(effect="drive.saturation", attaches="replace", replaces="SignalVoltage", starts(limit={0.99, 0.98, 0.96, 0.93, 0.88, 0.8, 0.65, 0.5, 0.35}), relative(limit="u"),
    signature="effort at large commands only", excitation="commands up to the limit", reference="Tao, Kokotovic 1996"));
end DriveSaturation;
