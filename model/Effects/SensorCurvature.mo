within Lacuna.Effects;
block SensorCurvature "Sensor whose reading bends"
  extends Lacuna.Interfaces.SISO;
  parameter Real gain(final min=0.1, final max=10) = 1 "Slope of the reading over the true value, at zero";
  parameter Real offset = 0 "Reading at zero";
  parameter Real bend = 0 "Half of the slope's change with the true value";
equation
  y = gain*u + offset + bend*u^2;
  annotation(__Lacuna(effect="sensor.nonlinearity", attaches="sensor", neutral(gain=1, offset=0, bend=0),
    signature="difference in one signal that grows with its square", excitation="large and small values of the signal",
    reference="Fraden 2016"));
end SensorCurvature;
