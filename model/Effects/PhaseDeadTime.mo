within Lacuna.Effects;
model PhaseDeadTime "Voltage lost against the sign of the current of a phase"
  extends Lacuna.Interfaces.TwoPin;
  parameter Types.Voltage V_d(final min=0) = 0 "Voltage lost";
  parameter Types.Current i_s(final min=1e-9) = 0.01 "Current within which the sign changes";
equation
  v = V_d*tanh(i/i_s);
  annotation(__Lacuna(effect="drive.dead_time", attaches="star", neutral(V_d=0), fixed={"i_s"},
    signature="constant voltage with the sign of the current",
    excitation="small currents of both signs", reference="Jeong, Park 1991"),
    Documentation(info="<html>
<p>Smooth near zero: currents of phases in star are not independent, so they cannot be held at zero one by one.</p>
</html>"));
end PhaseDeadTime;
