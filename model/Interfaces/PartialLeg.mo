within Lacuna.Interfaces;
partial model PartialLeg "One leg of an inverter on an inductive load: driven, or left to its two ideal diodes"
  constant Types.Current i_off = 1e-9 "Current below which a conducting diode is taken to have gone out";
  constant Types.Voltage v_on = 1e-6 "Voltage beyond a rail at which an open leg conducts again";
  PositivePin p "Positive rail";
  NegativePin n "Negative rail";
  NegativePin out "Terminal of the load";
  Boolean driven(start=true, fixed=true) "The switches set the potential; false: both are open";
  Types.PerUnit share "Share of the positive rail in the potential of a driven leg";
  Integer diode(start=0, fixed=true) "Conducting diode: 1 upper, -1 lower, 0 none";
  Types.Voltage v "Potential of the terminal";
  Types.Current i "Current into the load";
protected
  constant Types.Time T_open = 1e-3 "Decay time of the residual current of an open leg";
  constant Types.Inductance L_open = 1e-3 "Inductance that weights the slope of the current against a voltage";
  constant Types.PerUnit leak = 1e-12 "Share of the potential that sets the mean of a load that floats as a whole";
  constant Types.Current unitCurrent = 1;
  Boolean open "Neither driven nor conducting";
  Types.PerUnit upper "Share of the current that the positive rail carries";
  Integer forward(start=0) "Sign of the current at the moment when both switches open";
  Types.Current residue(start=0, fixed=true) "Residual current at the moment when an open leg conducts again";
  Types.Current reversed "How far the current of a conducting diode is beyond zero";
equation
  v = out.v;
  i = -out.i;
  upper = if driven then share elseif diode > 0 then 1 else 0;
  p.i = upper*i;
  n.i = (1 - upper)*i;
  0 = if open then L_open*(der(i) + i/T_open) + leak*(v - (p.v + n.v)/2) else v - upper*p.v - (1 - upper)*n.v;

  open = not driven and diode == 0;
  when {initial(), not driven} then
    forward = if i > i_off then 1 elseif i < -i_off then -1 else 0;
  end when;
  when diode <> 0 and pre(diode) == 0 and not pre(driven) then
    residue = abs(i);
  elsewhen driven then
    residue = 0;
  end when;
  reversed = if diode == 0 then -unitCurrent else diode*i;
  diode = if driven then 0
    elseif pre(driven) then -forward
    elseif pre(diode) == 0 then (if v > p.v + v_on then 1 elseif v < n.v - v_on then -1 else 0)
    elseif reversed > i_off + residue then 0 else pre(diode);
  annotation(Documentation(info="<html>
<p>A driven leg sets the terminal's potential whatever the sign of the current. With both switches open only the diodes
are left: a positive current comes from the negative rail through the lower one, a negative current returns to the
positive rail through the upper one. When it has run out the leg is open and the terminal takes the potential that the
load gives it, until that leaves the interval between the rails; then the diode at the rail that it passes conducts
again.</p>
<p>The current is a state of the load, so <em>open</em> is said of its derivative: <code>der(i) = 0</code> with
<code>i = 0</code>. What is left of the current when the event is found (below <code>i_off</code>) decays in
<code>T_open</code>. Currents of three phases at one star point are not independent, so the residue of the third is
not exactly zero; it is remembered when the leg conducts again, so that rounding cannot put the diode out at once.</p>
<p>The terminal must be connected to an inductive load. When every leg of an isolated load is open its potential would
be
undetermined; <code>leak</code> then puts its mean midway between the rails, at a current of picoamperes.</p>
</html>"));
end PartialLeg;
