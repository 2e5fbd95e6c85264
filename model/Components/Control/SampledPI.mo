within Lacuna.Components.Control;
block SampledPI "Proportional-integral controller of a digital control unit"
  extends Interfaces.SISO(y(start=0, fixed=true));
  parameter Types.Time T(final min=1e-6, start=1e-3) "Sampling period";
  parameter Real k(start=1) "Gain";
  parameter Types.Time Ti(final min=1e-9, start=1) "Integral time";
  parameter Real y_max(start=1) "Upper limit of the output";
  parameter Real y_min = -y_max "Lower limit of the output";
protected
  Real x(start=0, fixed=true) "Integral of the input over Ti";
  Real y_free(start=0, fixed=true) "Output before the limit";
equation
  when sample(0, T) then
    y_free = k*(u + pre(x));
    y = max(y_min, min(y_max, y_free));
    x = if (y_free > y_max and k*u > 0) or (y_free < y_min and k*u < 0) then pre(x) else pre(x) + T/Ti*u;
  end when;
  annotation(Documentation(info="<html>
<p><code>PI</code> with the integral by forward differences: <code>x(n+1) = x(n) + T/Ti u(n)</code>. The output is
held between
samples and appears without computing time.</p>
</html>"));
end SampledPI;
