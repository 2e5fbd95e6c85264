within Lacuna.Effects;
model TorqueDelay "Torque source that follows its command after a fixed time"
  extends Interfaces.SampledDelay(u(unit="N.m"));
  Lacuna.Interfaces.Flange_b flange "Driven flange";
equation
  flange.tau = -late;
  annotation(__Lacuna(effect="drive.delay", attaches="replace", replaces="TorqueSource", starts(T_d={5e-4, 1e-3, 2e-3, 6e-3, 0.015, 0.03}),
    interval="interval",
    signature="effort in proportion to the slope of the command", excitation="steps or fast changes of the command",
    reference="Franklin, Powell, Workman 1998"));
end TorqueDelay;
