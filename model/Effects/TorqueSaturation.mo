within Lacuna.Effects;
model TorqueSaturation "Torque source with a limit"
  Lacuna.Interfaces.RealInput u(unit="N.m") "Commanded torque";
  Lacuna.Interfaces.Flange_b flange "Driven flange";
  parameter Types.Torque limit(final min=0) = 1e6 "Greatest torque";
equation
  flange.tau = -noEvent(min(max(u, -limit), limit));
  annotation(__Lacuna(effect="drive.saturation", attaches="replace", replaces="TorqueSource", starts(limit={0.99, 0.98, 0.96, 0.93, 0.88, 0.8, 0.65, 0.5, 0.35}), relative(limit="u"),
    signature="effort at large commands only", excitation="commands up to the limit", reference="Tao, Kokotovic 1996"));
end TorqueSaturation;
