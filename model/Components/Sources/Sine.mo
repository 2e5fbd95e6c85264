within Lacuna.Components.Sources;
block Sine "Sine"
  extends Interfaces.Source;
  parameter Real amplitude = 1 "Amplitude";
  parameter Types.Frequency f(final min=0) = 1 "Frequency";
  parameter Types.Angle phase = 0 "Phase at the start";
  parameter Real offset = 0 "Mean";
  parameter Types.Time t_start = 0 "Before this, the value at the start";
protected
  constant Real pi = 3.141592653589793;
equation
  y = offset + amplitude*sin(phase + (if time < t_start then 0 else 2*pi*f*(time - t_start)));
  annotation(Documentation(info="<html>
<p>Law: <code>offset + amplitude sin(2 pi f (t - t_start) + phase)</code>.</p>
</html>"));
end Sine;
