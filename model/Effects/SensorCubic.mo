within Lacuna.Effects;
block SensorCubic "Sensor whose reading bends alike to both sides"
  extends Lacuna.Interfaces.SISO;
  parameter Real gain(final min=0.1, final max=10) = 1 "Slope of the reading over the true value, at zero";
  parameter Real offset = 0 "Reading at zero";
  parameter Real cubic = 0 "Sixth of the slope's second derivative";
equation
  y = gain*u + offset + cubic*u^3;
  annotation(__Lacuna(effect="sensor.nonlinearity", attaches="sensor", neutral(gain=1, offset=0, cubic=0),
    signature="difference in one signal that grows with its cube", excitation="large values of the signal to both sides",
    reference="Fraden 2016"));
end SensorCubic;
