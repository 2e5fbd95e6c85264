within Lacuna.Components.Control;
block PI "Proportional-integral controller with a limited output and anti-windup"
  extends Interfaces.SISO;
  parameter Real k(start=1) "Gain";
  parameter Types.Time Ti(final min=1e-9, start=1) "Integral time";
  parameter Real y_max(start=1) "Upper limit of the output";
  parameter Real y_min = -y_max "Lower limit of the output";
  Real x(start=0, fixed=true) "Integral of the input over Ti";
protected
  Real y_free "Output before the limit";
  Real beyond "How far it is beyond the limit towards which the input drives it";
  constant Types.PerUnit onset = 1e-3 "Part of the range over which holding sets in";
equation
  assert(y_min < y_max, "PI: y_min must be below y_max");
  y_free = k*(u + x);
  y = if y_free > y_max then y_max elseif y_free < y_min then y_min else y_free;
  beyond = noEvent(if k*u > 0 then y_free - y_max else y_min - y_free);
  Ti*der(x) = u*max(0, min(1, 1 - beyond/(onset*(y_max - y_min))));
  annotation(Documentation(info="<html>
<p>Law: <code>y = k (u + integral(u)/Ti)</code> within the limits. The integral is held while the output is at its limit and
the input would drive it further in (conditional integration), so it leaves the limit without delay. Holding sets in over
a thousandth of the range rather than at a point: where integrating crosses the limit and holding falls back from it, the
true motion is along the limit, and a switch would chatter there. Where the input changes its sign there is no event:
what is held then changes by nothing that jumps while the output is within its limits, and a loop at rest would turn on
and on about zero.</p>
<p>Reference: K. J. Astrom, T. Hagglund: PID Controllers, 2nd ed., ISA 1995, section 3.5.</p>
</html>"));
end PI;
