within Lacuna.Components.Drives;
model HalfBridge "One leg of an inverter: two ideal switches with ideal diodes, on an inductive load"
  parameter Types.Current i_off(final min=0) = 1e-9 "Current below which a conducting diode is taken to have gone out";
  parameter Types.Voltage v_on(final min=0) = 1e-9 "Voltage beyond a rail at which an open leg conducts again";
  Interfaces.PositivePin p "Positive rail";
  Interfaces.NegativePin n "Negative rail";
  Interfaces.NegativePin out "Terminal of the load";
  Interfaces.IntegerInput u "1: upper switch closed, -1: lower switch closed, 0: both open";
  Integer rail(start=0) "Rail to which the terminal is joined, by switch or diode: 1 positive, -1 negative, 0 neither";
  Types.Voltage v "Potential of the terminal";
  Types.Current i "Current into the load";
protected
  parameter Types.Time T_open = 1e-4 "Decay time of the residual current of an open leg";
  parameter Types.Inductance L_open = 1e9 "Leakage of an open leg; it only sets the potential of a circuit that floats as a whole";
  constant Types.Voltage unitVoltage = 1;
  constant Types.CurrentSlope unitSlope = 1;
  Real s(start=0) "Path variable: potential when open, slope of the current when joined to a rail";
  Integer forward(start=0) "Sign of the current at the moment when both switches open";
  Types.Current residue(start=0, fixed=true) "Residual current at the moment when an open leg conducts again";
  Types.Current reversed "How far a diode's current is beyond zero";
equation
  v = out.v;
  i = -out.i;
  p.i = if rail > 0 then i else 0;
  n.i = if rail > 0 then 0 else i;
  v = if rail > 0 then p.v elseif rail < 0 then n.v else s*unitVoltage;
  der(i) = if rail == 0 then -i/T_open - (v - (p.v + n.v)/2)/L_open else s*unitSlope;

  when u == 0 then
    forward = if i > i_off then 1 elseif i < -i_off then -1 else 0;
  end when;
  when rail <> 0 and pre(rail) == 0 then
    residue = abs(i);
  elsewhen u <> 0 then
    residue = 0;
  end when;
  reversed = if u == 0 then rail*i else 0;
  rail = if u <> 0 then u
    elseif pre(u) <> 0 then -forward
    elseif pre(rail) == 0 then (if v > p.v + v_on then 1 elseif v < n.v - v_on then -1 else 0)
    elseif reversed > i_off + residue then 0 else pre(rail);
  annotation(Documentation(info="<html>
<p>A closed switch joins the terminal to its rail whatever the sign of the current. With both switches open only the
diodes are left: a positive current comes from the negative rail through the lower one, a negative current returns to the
positive rail through the upper one. When it has run out the leg is open and the terminal takes the potential that the
load gives it, until that leaves the interval between the rails; then the diode at the rail that it passes conducts
again.</p>
<p>The current is a state of the load, so <em>open</em> is said of its derivative: <code>der(i) = 0</code> with
<code>i = 0</code>. What is left of the current when the event is found (below <code>i_off</code>) decays in
<code>T_open</code>. Currents of three phases at one star point are not independent, so the residue of the third is
not exactly zero; it is remembered when the leg conducts again, so that rounding cannot put the diode out at once.
Slope and potential share one unknown, <code>s</code>, as on the characteristic of an ideal diode.</p>
<p>The terminal must be connected to an inductive load. When every leg of an isolated load is open its potential would be
undetermined; <code>L_open</code> then puts its mean midway between the rails, at a current of picoamperes.</p>
</html>"));
end HalfBridge;
