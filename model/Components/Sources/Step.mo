within Lacuna.Components.Sources;
block Step "Step"
  extends Interfaces.Source;
  parameter Real height = 1 "Height of the step";
  parameter Real offset = 0 "Value before the step";
  parameter Types.Time t_start = 0 "Time of the step";
equation
  y = offset + (if time >= t_start then height else 0);
  annotation(Documentation(info="<html>
<p><code>offset</code> until <code>t_start</code>, then <code>offset + height</code>.</p>
</html>"));
end Step;
