within Lacuna.Effects.Interfaces;
partial model SampledDelay "Command that arrives after a fixed time"
  Lacuna.Interfaces.RealInput u "Command";
  parameter Types.Time T_d(final min=0, final max=0.06) = 1e-3 "Delay";
  parameter Types.Time interval(final min=1e-6) = 1e-3 "Time between the samples of the command";
  Real late "Command as it arrives";
protected
  constant Integer length = 64 "Samples that are kept";
  discrete Real kept[length](each start=0, each fixed=true) "Latest samples, newest first";
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
  late = sum(kept[k]*noEvent(max(0, 1 - abs((time - T_d - latest)/interval + k - 1))) for k in 1:length);
  annotation(Documentation(info="<html>
<p>The command is sampled and interpolated linearly between samples, which is exact for a command recorded at that
<code>interval</code>. The delay is at most 63 samples and at least one, as the sample after the present one is not known.</p>
</html>"));
end SampledDelay;
