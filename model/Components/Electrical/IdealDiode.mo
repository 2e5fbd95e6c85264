within Lacuna.Components.Electrical;
model IdealDiode "Diode that is a short circuit forward and nearly open backward"
  extends Interfaces.TwoPin;
  parameter Types.Resistance Ron(final min=0) = 1e-5 "Resistance when conducting";
  parameter Types.Resistance Roff(final min=1) = 1e5 "Resistance when blocking";
  parameter Types.Voltage Vknee(final min=0) = 0 "Forward voltage at which it begins to conduct";
  Boolean off(start=true) "Blocking";
protected
  Real s(start=0)
    "Path along the characteristic: voltage in units of 1 V when blocking, current in units of 1 A when conducting";
  constant Types.Voltage unitVoltage = 1;
  constant Types.Current unitCurrent = 1;
equation
  off = s < 0;
  v = s*unitVoltage*(if off then 1 else Ron*unitCurrent/unitVoltage) + Vknee;
  i = s*unitCurrent*(if off then unitVoltage/(Roff*unitCurrent) else 1) + Vknee/Roff;
  annotation(Documentation(info="<html>
<p>A characteristic with a vertical and a horizontal part is a function of neither <code>v</code> nor <code>i</code>;
it is one
of the path variable <code>s</code>, negative when blocking. The change happens at an event where <code>s</code>
passes zero,
and both <code>v</code> and <code>i</code> are continuous there.</p>
<p>Limit cases: <code>Ron = 0</code> is an ideal short circuit, <code>Roff</code> large an open one. A diode in series
with an
inductor keeps a residual current of <code>v/Roff</code>; for a leg that must be truly open see
<code>Drives.HalfBridge</code>.</p>
<p>Reference: C. Clauss, J. Haase, G. Kurth, P. Schwarz: Extended admittance description of nonlinear n-poles, AEU 49
(1995).</p>
</html>"));
end IdealDiode;
