within Lacuna.Effects;
block SensorSaturation "Sensor that reads no further than its range"
  extends Lacuna.Interfaces.SISO;
  parameter Real limit(final min=0) = 1e30 "Greatest reading to either side";
  // tried from just below what was read at most: at the end of its range a sensor reads just that
equation
  y = noEvent(min(max(u, -limit), limit));
  annotation(__Lacuna(effect="sensor.saturation", attaches="sensor", starts(limit={0.98}), relative(limit="u"),
    signature="one signal as believed up to a level, and no further", excitation="large values of the signal", reference="Fraden 2016"));
end SensorSaturation;
