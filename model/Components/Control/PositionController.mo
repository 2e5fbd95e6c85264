within Lacuna.Components.Control;
block PositionController "Position and speed loops in continuous time"
  extends Interfaces.PartialController;
  parameter Types.PerUnit onset(final min=1e-9) = 1e-2 "Part of the limit over which holding sets in";
  Types.AngularVelocity w_ref "Reference speed";
  Types.Current x(start=0, fixed=true) "Integral part of the reference current";
protected
  Types.AngularVelocity w_free "Reference speed before its limit";
  Types.AngularVelocity error "Speed error";
  Types.Current i_free "Reference current before its limit";
  Types.Current beyond "How far it is beyond the limit towards which the error drives it";
equation
  w_free = Kp*N*(command - position);
  w_ref = if w_free > w_max then w_max elseif w_free < -w_max then -w_max else w_free;
  error = w_ref - speed;
  i_free = Kw*error + x;
  i_ref = if i_free > i_max then i_max elseif i_free < -i_max then -i_max else i_free;
  beyond = noEvent(if error > 0 then i_free else -i_free) - i_max;
  der(x) = Ki*error*max(0, min(1, 1 - beyond/(onset*i_max)));
  annotation(Documentation(info="<html>
<p>See <code>Interfaces.PartialController</code> for the law, and <code>PI</code> for how
the integral is held.</p>
</html>"));
end PositionController;
