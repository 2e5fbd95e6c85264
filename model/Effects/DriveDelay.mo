within Lacuna.Effects;
model DriveDelay "Source that follows its command after a fixed time"
  extends Lacuna.Interfaces.TwoPin;
  extends Interfaces.SampledDelay(u(unit="V"));
equation
  v = late;
  annotation(__Lacuna(effect="drive.delay", attaches="replace", replaces="SignalVoltage", starts(T_d={0.3, 0.7, 1.5, 3, 7, 15, 30}), relative(T_d="interval"),
    interval="interval",
    signature="effort in proportion to the slope of the command", excitation="steps or fast changes of the command",
    reference="Franklin, Powell, Workman 1998"));
end DriveDelay;
