within Lacuna.Effects;
block DriveSaturation "Limit of the drive's output"
  extends Lacuna.Interfaces.SISO;
  parameter Real limit(final min=0) = 1e6 "Greatest output";
equation
  y = noEvent(min(max(u, -limit), limit));
  annotation(__Lacuna(effect="drive.saturation", attaches="signal", location="drive",
    starts(limit={0.95, 0.8, 0.6}), relative(limit="u"),
    signature="effort at large commands only", excitation="commands up to the limit", reference="Tao, Kokotovic 1996"));
end DriveSaturation;
