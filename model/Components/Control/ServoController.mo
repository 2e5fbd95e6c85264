within Lacuna.Components.Control;
block ServoController "Cascade of a position loop and a speed loop that commands a voltage"
  extends Interfaces.PartialServoController;
  Types.AngularVelocity wref "Reference speed";
  Types.Angle xi(start=0, fixed=true) "Integral of the speed error";
  Types.Voltage u_free "Voltage command before the limit";
protected
  Types.AngularVelocity w_free "Reference speed before the limit";
  Types.AngularVelocity error "Speed error";
  Types.Voltage beyond "How far the command is beyond the limit towards which the error drives it";
  constant Types.PerUnit onset = 2e-4 "Part of the limit over which holding sets in";
equation
  w_free = Kp*N*(command - position);
  wref = if w_free > wmax then wmax elseif w_free < -wmax then -wmax else w_free;
  error = wref - speed;
  u_free = Kw*error + Ki*xi;
  u = if u_free > Vdc then Vdc elseif u_free < -Vdc then -Vdc else u_free;
  beyond = noEvent(if error > 0 then u_free else -u_free) - Vdc;
  der(xi) = error*max(0, min(1, 1 - beyond/(onset*Vdc)));
  annotation(Documentation(info="<html>
<p>Proportional position loop with a limited speed reference, and a proportional-integral speed loop whose integral is
held while the voltage is at its limit and the error would drive it further in. On <code>N</code>: the position is that of
the output, the speed that of the motor.</p>
<p>Holding sets in over <code>onset</code> of the limit rather than at a point: where integrating crosses the limit and
holding falls back from it, the true motion is along the limit, and a switch would chatter there.</p>
</html>"));
end ServoController;
