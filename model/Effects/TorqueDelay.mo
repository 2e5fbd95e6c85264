within Lacuna.Effects;
model TorqueDelay "Torque source that follows its command after a fixed time"
  extends Interfaces.SampledDelay(u(unit="N.m"));
  Lacuna.Interfaces.Flange_b flange "Driven flange";
equation
  flange.tau = -late;
  annotation(__Lacuna(effect="drive.delay", attaches="replace", replaces="TorqueSource", starts(T_d={0.5, 1, 2, 6, 15, 30}), relative(T_d="interval"),
    interval="interval",
    signature="effort in proportion to the slope of the command", excitation="steps or fast changes of the command",
    reference="Franklin, Powell, Workman 1998"));
end TorqueDelay;
