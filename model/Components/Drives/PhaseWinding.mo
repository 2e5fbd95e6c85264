within Lacuna.Components.Drives;
model PhaseWinding "Winding of one phase: resistance, inductance and a back-EMF that depends on angle"
  extends Interfaces.TwoPin(i(start=0));
  parameter Types.Resistance R(final min=0, start=1) "Resistance of the healthy winding";
  parameter Types.Inductance L(final min=1e-9, start=1e-3) "Inductance of the healthy winding";
  parameter Types.PerUnit shorted(final min=0, final max=0.99) = 0 "Fraction of the turns that is shorted";
  Interfaces.Flange_b flange "Shaft";
  Interfaces.RealInput k(unit="V.s/rad") "Back-EMF and torque constant of the healthy winding at the present angle";
  Types.AngularVelocity w "Speed of the shaft";
  Types.Voltage e "Back-EMF";
  Types.Torque tau "Torque on the shaft";
  Types.Power loss "Heat";
  Types.Energy stored "Magnetic energy";
protected
  parameter Types.PerUnit turns = 1 - shorted "Fraction of the turns that is left";
equation
  w = der(flange.phi);
  e = turns*k*w;
  turns*turns*L*der(i) = v - turns*R*i - e;
  tau = turns*k*i;
  flange.tau = -tau;
  loss = turns*R*i*i;
  stored = turns*turns*L*i*i/2;
  annotation(Documentation(info="<html>
<p>Laws: <code>L der(i) = v - R i - k w</code> and torque <code>k i</code>; one constant in both, so electrical power
<code>e i</code> is mechanical power <code>tau w</code>. When a fraction <code>f</code> of the turns is shorted,
resistance
and back-EMF fall with the turns left, <code>1 - f</code>, and the inductance with their square.</p>
<p>Reference: M. Battipede, M. D. L. Dalla Vedova, P. Maggiore, S. Romeo: Model based analysis of precursors of
electromechanical servomechanisms failures using an artificial neural network, AIAA MST 2015.</p>
</html>"));
end PhaseWinding;
