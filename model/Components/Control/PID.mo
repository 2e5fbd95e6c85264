within Lacuna.Components.Control;
block PID "Proportional-integral-derivative controller with a filtered derivative, limits and anti-windup"
  extends Interfaces.SISO;
  parameter Real k(start=1) "Gain";
  parameter Types.Time Ti(final min=1e-9, start=1) "Integral time";
  parameter Types.Time Td(final min=0, start=0.1) "Derivative time";
  parameter Types.PerUnit Nd(final min=1) = 10 "Gain limit of the derivative";
  parameter Real y_max(start=1) "Upper limit of the output";
  parameter Real y_min = -y_max "Lower limit of the output";
  Real x(start=0, fixed=true) "Integral of the input over Ti";
  Real x_d(start=0, fixed=true) "Input behind the derivative's filter";
protected
  parameter Types.Time Tf = max(Td/Nd, 1e-9) "Time constant of the derivative's filter";
  Real y_free "Output before the limit";
  Real beyond "How far it is beyond the limit towards which the input drives it";
  constant Types.PerUnit onset = 1e-3 "Part of the range over which holding sets in";
equation
  assert(y_min < y_max, "PID: y_min must be below y_max");
  Tf*der(x_d) = u - x_d;
  y_free = k*(u + x + Td/Tf*(u - x_d));
  y = if y_free > y_max then y_max elseif y_free < y_min then y_min else y_free;
  beyond = noEvent(if k*u > 0 then y_free - y_max else y_min - y_free);
  Ti*der(x) = u*max(0, min(1, 1 - beyond/(onset*(y_max - y_min))));
  annotation(Documentation(info="<html>
<p>Law: <code>y = k (1 + 1/(Ti s) + Td s/(1 + Td/Nd s)) u</code> within the limits; <code>Td = 0</code> is
<code>PI</code>.
How the integral is held at a limit is said in <code>PI</code>. The
filter starts at zero, so a step of the input at the start is differentiated too.</p>
</html>"));
end PID;
