within Lacuna.Effects;
block SensorDeadBand "Sensor that shows nothing of small values"
  extends Lacuna.Interfaces.SISO;
  parameter Real least(final min=0) = 1e-30 "Value from which it shows them";
  // it begins to show them within a tenth of the least value: a step has no slope by which a fit could move it
equation
  y = u*(1 + tanh(20*(noEvent(abs(u))/least - 1)))/2;
  annotation(__Lacuna(effect="sensor.dead_band", attaches="sensor", starts(least={0.02, 0.06, 0.2}), relative(least="u"),
    signature="one signal as believed but for small values, which it has not", excitation="small values of the signal",
    reference="Fraden 2016"));
end SensorDeadBand;
