within Lacuna.Components.Monitors;
block Supervisor "Trips when a signal stays beyond a limit for a confirmation time"
  parameter Real limit(final min=0, start=1) "Largest permitted magnitude";
  parameter Types.Time t_confirm(final min=0, start=0.1) "Time for which it must be exceeded without a break";
  Interfaces.RealInput u "Supervised signal";
  Interfaces.BooleanOutput tripped(start=false, fixed=true) "It has tripped; latched";
  Types.Time t_trip(start=-1, fixed=true) "Time of the trip; -1: none";
  Boolean exceeded "Beyond the limit now";
protected
  constant Types.Time never = 1e30 "Later than any run";
  Types.Time t_due(start=never, fixed=true) "Time at which the present excess is confirmed";
equation
  exceeded = abs(u) > limit;
  when {initial(), change(exceeded)} then
    t_due = if exceeded then time + t_confirm else never;
  end when;
  when time >= t_due then
    tripped = true;
    t_trip = if pre(tripped) then pre(t_trip) else time;
  end when;
  annotation(Documentation(info="<html>
<p>Following error, over-current and over-speed are supervised in this way: a short excess is a transient, a confirmed
one a
fault. The flag is latched and the time of the first trip kept. With <code>t_confirm = 0</code> it trips at once.</p>
</html>"));
end Supervisor;
