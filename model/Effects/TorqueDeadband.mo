within Lacuna.Effects;
model TorqueDeadband "Torque source without output for small commands"
  Lacuna.Interfaces.RealInput u(unit="N.m") "Commanded torque";
  Lacuna.Interfaces.Flange_b flange "Driven flange";
  parameter Types.Torque width(final min=0) = 0 "Half width of the band without output";
equation
  flange.tau = noEvent(if u > width then width - u elseif u < -width then -u - width else 0);
  annotation(__Lacuna(effect="drive.deadband", attaches="replace", replaces="TorqueSource", neutral(width=0),
    signature="effort with the sign of the command, nothing for small commands", excitation="slow passage of the command through zero", reference="Tao, Kokotovic 1996"));
end TorqueDeadband;
