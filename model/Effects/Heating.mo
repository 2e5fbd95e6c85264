within Lacuna.Effects;
model Heating "Resistance rising as the winding warms"
  extends Lacuna.Interfaces.TwoPin;
  parameter Real k_R(unit="V/A3", final min=0) = 0 "Final rise of the cold resistance over the square of the current";
  parameter Types.Time tau_th(final min=1e-3) = 10 "Thermal time constant";
  parameter Types.Resistance R_0(final min=1e-3) = 2 "Resistance of the cold winding: as it rises, so does the heat";
  Lacuna.Interfaces.RealInput rise(unit="Ohm") "Rise of the resistance by the heat of all phases";
  Types.Resistance dR(start=0, fixed=true) "Rise by the heat of this phase";
equation
  der(dR) = (k_R*i*i*(1 + rise/R_0) - dR)/tau_th;
  v = rise*i;
  annotation(__Lacuna(effect="motor.heating", attaches="phases", neutral(k_R=0), summed(rise="dR"), starts(tau_th={0.05, 0.3, 2}, R_0={2}), relative(tau_th="duration"),
    signature="voltage that follows the current and grows with the heat put in; a drift over the recording",
    excitation="large currents for longer than the thermal time constant", reference="Hendershot, Miller 2010"),
    Documentation(info="<html>
<p>The windings of a machine share one temperature; its equation is linear in the heat, so each phase keeps its own share
of the rise and all of them carry the sum. The heat is that of the warm resistance.</p>
</html>"));
end Heating;
