within Lacuna.Effects;
model Heating "Resistance rising as the winding warms"
  extends Lacuna.Interfaces.TwoPin;
  parameter Real k_R(unit="V/A3", final min=0) = 0 "Final rise of the resistance over the square of the current";
  parameter Types.Time tau_th(final min=1e-3) = 10 "Thermal time constant";
  Types.Resistance dR(start=0, fixed=true) "Rise of the resistance";
equation
  der(dR) = (k_R*i*i - dR)/tau_th;
  v = dR*i;
  annotation(__Lacuna(effect="motor.heating", attaches="phases", neutral(k_R=0), starts(tau_th={0.3, 2, 15}),
    signature="voltage that follows the current and grows with the heat put in; a drift over the recording",
    excitation="large currents for longer than the thermal time constant", reference="Hendershot, Miller 2010"));
end Heating;
