within Lacuna.Components.Control;
block SampledPID "Proportional-integral-derivative controller of a digital control unit"
  extends Interfaces.SISO(y(start=0, fixed=true));
  parameter Types.Time T(final min=1e-6, start=1e-3) "Sampling period";
  parameter Real k(start=1) "Gain";
  parameter Types.Time Ti(final min=1e-9, start=1) "Integral time";
  parameter Types.Time Td(final min=0, start=0.1) "Derivative time";
  parameter Types.PerUnit Nd(final min=1) = 10 "Gain limit of the derivative";
  parameter Real y_max(start=1) "Upper limit of the output";
  parameter Real y_min = -y_max "Lower limit of the output";
protected
  parameter Types.Time Tf = Td/Nd "Time constant of the derivative's filter";
  Real x(start=0, fixed=true) "Integral of the input over Ti";
  Real d(start=0, fixed=true) "Filtered derivative part";
  Real u_last(start=0, fixed=true) "Input at the last sample";
  Real y_free(start=0, fixed=true) "Output before the limit";
equation
  when sample(0, T) then
    d = (Tf*pre(d) + Td*(u - pre(u_last)))/(Tf + T);
    u_last = u;
    y_free = k*(u + pre(x) + d);
    y = max(y_min, min(y_max, y_free));
    x = if (y_free > y_max and k*u > 0) or (y_free < y_min and k*u < 0) then pre(x) else pre(x) + T/Ti*u;
  end when;
  annotation(Documentation(info="<html>
<p><code>PID</code> with the integral by forward and the derivative by backward differences. <code>Td = 0</code> is
<code>SampledPI</code>.</p>
</html>"));
end SampledPID;
