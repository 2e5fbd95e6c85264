within Lacuna.Components.Control;
block PositionController "Position and speed loops in continuous time"
  extends Interfaces.PartialController;
  Types.AngularVelocity w_ref "Reference speed";
  Types.Current x(start=0, fixed=true) "Integral part of the reference current";
protected
  Types.AngularVelocity w_free "Reference speed before its limit";
  Types.AngularVelocity error "Speed error";
  Types.Current i_free "Reference current before its limit";
equation
  w_free = Kp*N*(command - position);
  w_ref = if w_free > w_max then w_max elseif w_free < -w_max then -w_max else w_free;
  error = w_ref - speed;
  i_free = Kw*error + x;
  i_ref = if i_free > i_max then i_max elseif i_free < -i_max then -i_max else i_free;
  der(x) = if i_free > i_max and error > 0 or i_free < -i_max and error < 0 then 0 else Ki*error;
  annotation(Documentation(info="<html>
<p>See <code>Interfaces.PartialController</code> for the law.</p>
</html>"));
end PositionController;
