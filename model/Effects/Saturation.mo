within Lacuna.Effects;
model Saturation "Torque and back-EMF constant falling with current"
  extends Lacuna.Interfaces.TwoPin(i(start=0));
  parameter Types.Resistance R(final min=0, start=1) "Resistance";
  parameter Types.Inductance L(final min=1e-9, start=1e-3) "Inductance";
  parameter Types.BackEmfConstant Ke(start=0.03) "Constant without current";
  parameter Real k_sat(unit="1/A2", final min=0) = 0 "Inverse square of the current at which the constant has halved";
  Lacuna.Interfaces.Flange_b flange "Shaft";
  Types.AngularVelocity w "Speed of the shaft";
  Types.Voltage e "Back-EMF";
  Types.Torque tau "Torque on the shaft";
  Types.BackEmfConstant k "Constant at the present current";
equation
  w = der(flange.phi);
  k = Ke/(1 + k_sat*i*i);
  e = k*w;
  L*der(i) = v - R*i - e;
  tau = k*i;
  flange.tau = -tau;
  annotation(__Lacuna(effect="motor.saturation", attaches="replace", replaces="DcWinding", neutral(k_sat=0),
    signature="less torque for large currents", excitation="currents up to the greatest, and small ones",
    reference="Hendershot, Miller 2010"));
end Saturation;
