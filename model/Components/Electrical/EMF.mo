within Lacuna.Components.Electrical;
model EMF "Ideal electromechanical converter with a constant"
  extends Interfaces.TwoPin;
  parameter Types.BackEmfConstant k(start=0.03) "Back-EMF constant, which is also the torque constant";
  Types.AngularVelocity w "Speed of the flange";
  Interfaces.Flange_b flange "Shaft";
equation
  w = der(flange.phi);
  v = k*w;
  flange.tau = -k*i;
  annotation(Documentation(info="<html>
<p>Laws: <code>v = k w</code> and torque on the shaft <code>k i</code>. Without loss: <code>v i = k i w</code>.</p>
</html>"));
end EMF;
