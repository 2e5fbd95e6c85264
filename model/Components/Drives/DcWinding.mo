within Lacuna.Components.Drives;
model DcWinding "Armature of a DC machine: resistance, inductance and constant back-EMF"
  extends Interfaces.TwoPin(i(start=0));
  parameter Types.Resistance R(final min=0, start=1) "Resistance";
  parameter Types.Inductance L(final min=1e-9, start=1e-3) "Inductance";
  parameter Types.BackEmfConstant Ke(start=0.03) "Back-EMF constant, which is also the torque constant";
  Interfaces.Flange_b flange "Shaft";
  Types.AngularVelocity w "Speed of the shaft";
  Types.Voltage e "Back-EMF";
  Types.Torque tau "Torque on the shaft";
  Types.Power loss "Heat";
  Types.Energy stored "Magnetic energy";
equation
  w = der(flange.phi);
  e = Ke*w;
  L*der(i) = v - R*i - e;
  tau = Ke*i;
  flange.tau = -tau;
  loss = R*i*i;
  stored = L*i*i/2;
  annotation(Documentation(info="<html>
<p>Laws: <code>L der(i) = v - R i - Ke w</code>, torque <code>Ke i</code>. It also stands for a brushless machine with
ideal
current control, seen from its direct-current side.</p>
</html>"));
end DcWinding;
