within Lacuna.Components.Drives;
block DeadTime "Both switches of a leg stay open for a while at each change of its command"
  parameter Types.Time t_dead(final min=0) = 1e-6 "Dead time";
  Interfaces.IntegerInput u "Command: 1, -1 or 0";
  Interfaces.IntegerOutput y(start=0) "Command that reaches the switches";
protected
  Boolean waiting(start=false, fixed=true) "Within the dead time";
  Types.Time t_ready(start=0, fixed=true) "End of the dead time";
equation
  when change(u) then
    waiting = t_dead > 0;
    t_ready = time + t_dead;
  elsewhen time >= pre(t_ready) then
    waiting = false;
    t_ready = pre(t_ready);
  end when;
  y = if waiting then 0 else u;
  annotation(Documentation(info="<html>
<p>Protects a leg from a short circuit through its two switches. In the dead time the current takes a diode, so the load
loses or gains voltage against the sign of its current: the distortion of real drives at low current.
<code>t_dead = 0</code>: the command passes as it is.</p>
</html>"));
end DeadTime;
