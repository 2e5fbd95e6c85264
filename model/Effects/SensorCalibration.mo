within Lacuna.Effects;
block SensorCalibration "Scale and zero error of a sensor"
  extends Lacuna.Interfaces.SISO;
  parameter Real gain(final min=0.1, final max=10) = 1 "Slope of the reading over the true value";
  parameter Real offset = 0 "Reading at zero";
equation
  y = gain*u + offset;
  annotation(__Lacuna(effect="sensor.gain", attaches="sensor", neutral(gain=1, offset=0), nests_in={"sensor.nonlinearity"},
    signature="difference in one signal in proportion to it and a constant", excitation="large and small values of the signal",
    reference="Fraden 2016"));
end SensorCalibration;
