within Lacuna.Effects;
model IronLoss "Winding whose iron draws a current of its own"
  extends Lacuna.Interfaces.TwoPin(i(start=0));
  parameter Types.Resistance R(final min=0, start=1) "Resistance";
  parameter Types.Inductance L(final min=1e-9, start=1e-3) "Inductance";
  parameter Types.BackEmfConstant Ke(start=0.03) "Back-EMF constant, which is also the torque constant";
  parameter Real G_fe(unit="A/V", final min=0) = 0 "Conductance of the iron, beside the winding's induced voltage";
  parameter Types.Time T_fe(final min=1e-6) = 2e-4 "Time constant of the iron's currents";
  Lacuna.Interfaces.Flange_b flange "Shaft";
  Types.AngularVelocity w "Speed of the shaft";
  Types.Voltage e "Back-EMF";
  Types.Current i_fe(start=0, fixed=true) "Current of the iron, seen from the winding";
  Types.Torque tau "Torque on the shaft";
equation
  w = der(flange.phi);
  e = Ke*w;
  T_fe*der(i_fe) = G_fe*(v - R*i) - i_fe;
  L*(der(i) - der(i_fe)) = v - R*i - e;
  tau = Ke*(i - i_fe);
  flange.tau = -tau;
  annotation(__Lacuna(effect="motor.iron_loss", attaches="replace", replaces="DcWinding", neutral(G_fe=0), fixed={"T_fe"},
    signature="torque missing in proportion to speed, with the current that is drawn for it",
    excitation="steps of the voltage, and high speed without load", reference="Hendershot, Miller 2010"),
    Documentation(info="<html>
<p>Eddy currents in the iron lie in parallel to the voltage that the winding induces, <code>v - R i</code>. At a steady speed
that is a loss torque <code>Ke^2 G_fe w</code>, which viscous friction would give too; only changes of the current tell the
two apart.</p>
</html>"));
end IronLoss;
