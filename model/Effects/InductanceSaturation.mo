within Lacuna.Effects;
model InductanceSaturation "Inductance falling with current"
  extends Lacuna.Interfaces.TwoPin(i(start=0));
  parameter Types.Resistance R(final min=0, start=1) "Resistance";
  parameter Types.Inductance L(final min=1e-9, start=1e-3) "Inductance without current";
  parameter Types.BackEmfConstant Ke(start=0.03) "Back-EMF constant, which is also the torque constant";
  parameter Real k_sat(unit="1/A2", final min=0) = 0 "Inverse square of the current at which the inductance has halved";
  Lacuna.Interfaces.Flange_b flange "Shaft";
  Types.AngularVelocity w "Speed of the shaft";
  Types.Voltage e "Back-EMF";
  Types.Torque tau "Torque on the shaft";
equation
  w = der(flange.phi);
  e = Ke*w;
  L/(1 + k_sat*i*i)*der(i) = v - R*i - e;
  tau = Ke*i;
  flange.tau = -tau;
  annotation(__Lacuna(effect="motor.saturation", attaches="replace", replaces="DcWinding", neutral(k_sat=0),
    signature="large currents change faster than small ones", excitation="steps of the voltage from rest and under load",
    reference="Hendershot, Miller 2010"));
end InductanceSaturation;
