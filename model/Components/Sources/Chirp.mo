within Lacuna.Components.Sources;
block Chirp "Sine whose frequency rises linearly"
  extends Interfaces.Source;
  parameter Real amplitude = 1 "Amplitude";
  parameter Types.Frequency f0(final min=0) = 0.1 "Frequency at the start";
  parameter Types.Frequency f1(final min=0) = 10 "Frequency at the end";
  parameter Types.Time duration(final min=1e-9) = 10 "Duration; after it the frequency stays at f1";
  parameter Real offset = 0 "Mean";
protected
  constant Real pi = 3.141592653589793;
  Types.Angle phase "Phase";
equation
  phase = if time < duration then 2*pi*time*(f0 + (f1 - f0)*time/(2*duration))
    else 2*pi*((f0 + f1)*duration/2 + f1*(time - duration));
  y = offset + amplitude*sin(phase);
  annotation(Documentation(info="<html>
<p>The instantaneous frequency is <code>f0 + (f1 - f0) t/duration</code>; its integral is the phase.</p>
</html>"));
end Chirp;
