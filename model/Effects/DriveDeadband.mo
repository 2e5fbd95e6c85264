within Lacuna.Effects;
model DriveDeadband "Source without output for small commands"
  extends Lacuna.Interfaces.TwoPin;
  Lacuna.Interfaces.RealInput u(unit="V") "Commanded voltage";
  parameter Types.Voltage width(final min=0) = 0 "Half width of the band without output";
equation
  v = noEvent(if u > width then u - width elseif u < -width then u + width else 0);
  annotation(__Lacuna(effect="drive.deadband", attaches="replace", replaces="SignalVoltage", neutral(width=0),
    signature="effort with the sign of the command, nothing for small commands", excitation="slow passage of the command through zero", reference="Tao, Kokotovic 1996"));
end DriveDeadband;
