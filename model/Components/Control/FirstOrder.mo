within Lacuna.Components.Control;
block FirstOrder "First-order low-pass section"
  extends Interfaces.SISO;
  parameter Types.Frequency f_c(final min=1e-6, start=100) "Corner frequency";
  parameter Real y_start = 0 "Initial output";
protected
  constant Real pi = 3.141592653589793;
  parameter Types.Time T = 1/(2*pi*f_c) "Time constant";
initial equation
  y = y_start;
equation
  T*der(y) = u - y;
  annotation(Documentation(info="<html>
<p>Law: <code>T der(y) = u - y</code>, <code>T = 1/(2 pi f_c)</code>: gain 1 at rest, -3 dB at <code>f_c</code>.</p>
</html>"));
end FirstOrder;
