within Lacuna.Effects;
block SensorSaturation "Sensor that reads no further than its range"
  extends Lacuna.Interfaces.SISO;
  parameter Real limit(final min=0) = 1e30 "Greatest reading to either side";
equation
  y = noEvent(min(max(u, -limit), limit));
  annotation(__Lacuna(effect="sensor.saturation", attaches="sensor", starts(limit={0.98, 0.93, 0.85, 0.7, 0.5}), relative(limit="u"),
    signature="one signal as believed up to a level, and no further", excitation="large values of the signal", reference="Fraden 2016"));
end SensorSaturation;
