within Lacuna.Effects;
model DriveDelay "Source that follows its command after a fixed time"
  extends Lacuna.Interfaces.TwoPin;
  extends Interfaces.SampledDelay(u(unit="V"));
equation
  v = late;
  annotation(__Lacuna(effect="drive.delay", attaches="replace", replaces="SignalVoltage", starts(T_d={3e-4, 7e-4, 1.5e-3, 3e-3, 7e-3, 0.015, 0.03}),
    interval="interval",
    signature="effort in proportion to the slope of the command", excitation="steps or fast changes of the command",
    reference="Franklin, Powell, Workman 1998"));
end DriveDelay;
