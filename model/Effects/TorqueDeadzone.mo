within Lacuna.Effects;
model TorqueDeadzone "Torque source that passes commands only beyond a threshold"
  Lacuna.Interfaces.RealInput u(unit="N.m") "Commanded torque";
  Lacuna.Interfaces.Flange_b flange "Driven flange";
  parameter Types.Torque width(final min=0) = 0 "Threshold of the command";
equation
  flange.tau = if noEvent(abs(u)) > width then -u else 0;
  annotation(__Lacuna(effect="drive.deadband", attaches="replace", replaces="TorqueSource", starts(width={0.03, 0.1, 0.2, 0.4}), relative(width="u"),
    signature="effort equal to the command while it is small", excitation="small commands", reference="Tao, Kokotovic 1996"));
end TorqueDeadzone;
