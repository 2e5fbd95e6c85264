within Lacuna.Effects.Interfaces;
model SampledDelay "Signal that arrives after a fixed time"
  Lacuna.Interfaces.RealInput u "Signal";
  parameter Types.Time T_d(final min=0) = 1e-3 "Delay";
  parameter Types.Time interval(final min=0) = 1e-3 "Time between the samples that are kept";
  Real late "Signal as it arrives";
protected
  constant Integer length = 64 "Samples that are kept";
  discrete Real kept[length](each start=0, each fixed=true) "Latest samples, newest first";
  discrete Types.Time latest(start=0, fixed=true) "Time of the newest";
  Types.Time age = time - latest "Time since the newest";
algorithm
  when {initial(), sample(0, interval)} then
    for k in length:-1:2 loop
      kept[k] := if initial() then u else pre(kept[k - 1]);
    end for;
    kept[1] := u;
    latest := time;
  end when;
equation
  assert(T_d <= (length - 1)*interval, "The delay is longer than what is kept");
  late = noEvent(if age > T_d then u + (kept[1] - u)*T_d/age
    else sum(kept[k]*max(0, 1 - abs((age - T_d)/interval + k - 1)) for k in 1:length));
  annotation(Documentation(info="<html>
<p>The signal is sampled and interpolated linearly between samples and from the newest one to the present, which is exact
for a signal recorded at that <code>interval</code>. The delay is at most 63 samples. Before the start it is taken to
have been what it is there.</p>
</html>"));
end SampledDelay;
