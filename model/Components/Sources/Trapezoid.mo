within Lacuna.Components.Sources;
block Trapezoid "Periodic trapezoid"
  extends Interfaces.Source;
  parameter Real amplitude = 1 "Height";
  parameter Real offset = 0 "Lowest value";
  parameter Types.Time rising(final min=1e-9) = 0.1 "Duration of the rise";
  parameter Types.Time width(final min=0) = 0.4 "Duration of the upper level";
  parameter Types.Time falling(final min=1e-9) = 0.1 "Duration of the fall";
  parameter Types.Time period(final min=1e-9) = 1 "Period";
  parameter Types.Time t_start = 0 "Begin of the first rise";
protected
  Types.Time t_period(start=t_start, fixed=true) "Begin of the present period";
  Types.Time t "Time within the period";
equation
  assert(rising + width + falling <= period, "Trapezoid: rise, upper level and fall must fit into the period");
  when sample(t_start, period) then
    t_period = time;
  end when;
  t = time - t_period;
  y = offset + amplitude*(if time < t_start then 0 elseif t < rising then t/rising elseif t < rising + width then 1
    elseif t < rising + width + falling then 1 - (t - rising - width)/falling else 0);
  annotation(Documentation(info="<html>
<p>Rise, upper level, fall, lower level, again and again. Short <code>rising</code> and <code>falling</code> make it a
square
wave.</p>
</html>"));
end Trapezoid;
