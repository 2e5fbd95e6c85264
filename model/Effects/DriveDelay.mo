within Lacuna.Effects;
model DriveDelay "Source that follows its command after a fixed time"
  extends Lacuna.Interfaces.TwoPin;
  Lacuna.Interfaces.RealInput u(unit="V") "Commanded voltage";
  parameter Types.Time T_d(final min=0, final max=0.06) = 1e-3 "Delay";
  parameter Types.Time interval(final min=1e-6) = 1e-3 "Time between the samples of the command";
protected
  constant Integer length = 64 "Samples that are kept";
  discrete Types.Voltage kept[length](each start=0, each fixed=true) "Latest samples, newest first";
  discrete Types.Time latest(start=0, fixed=true) "Time of the newest";
algorithm
  when sample(0, interval) then
    for k in length:-1:2 loop
      kept[k] := pre(kept[k - 1]);
    end for;
    kept[1] := u;
    latest := time;
  end when;
equation
  v = sum(kept[k]*noEvent(max(0, 1 - abs((time - T_d - latest)/interval + k - 1))) for k in 1:length);
  annotation(__Lacuna(effect="drive.delay", attaches="replace", replaces="SignalVoltage", starts(T_d={2e-3, 6e-3, 0.015, 0.03}),
    interval="interval",
    signature="effort in proportion to the slope of the command", excitation="steps or fast changes of the command",
    reference="Franklin, Powell, Workman 1998"),
    Documentation(info="<html>
<p>The command is sampled and interpolated linearly between samples, which is exact for a command recorded at that
<code>interval</code>. The delay is at most 63 samples and at least one, as the sample after the present one is not known.</p>
</html>"));
end DriveDelay;
