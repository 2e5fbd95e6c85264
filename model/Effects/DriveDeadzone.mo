within Lacuna.Effects;
model DriveDeadzone "Source that passes commands only beyond a threshold"
  extends Lacuna.Interfaces.TwoPin;
  Lacuna.Interfaces.RealInput u(unit="V") "Commanded voltage";
  parameter Types.Voltage width(final min=0) = 0 "Threshold of the command";
equation
  v = if noEvent(abs(u)) > width then u else 0;
  annotation(__Lacuna(effect="drive.deadband", attaches="replace", replaces="SignalVoltage", starts(width={0.03, 0.1, 0.2}), relative(width="u"),
    signature="effort equal to the command while it is small", excitation="small commands", reference="Tao, Kokotovic 1996"));
end DriveDeadzone;
