within Lacuna.Components.Sources;
block Ramp "Ramp"
  extends Interfaces.Source;
  parameter Real height = 1 "Rise";
  parameter Types.Time duration(final min=1e-9) = 1 "Duration of the rise";
  parameter Real offset = 0 "Value before the rise";
  parameter Types.Time t_start = 0 "Begin of the rise";
equation
  y = offset + (if time < t_start then 0 elseif time < t_start + duration then height*(time - t_start)/duration
    else height);
  annotation(Documentation(info="<html>
<p>Rises from <code>offset</code> by <code>height</code> within <code>duration</code>; both corners are time events.</p>
</html>"));
end Ramp;
