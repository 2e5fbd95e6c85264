within Lacuna.Effects;
block SensorGain "Scale error of a sensor"
  extends Lacuna.Interfaces.SISO;
  parameter Real gain(final min=0.1, final max=10) = 1 "Reading over true value";
equation
  y = gain*u;
  annotation(__Lacuna(effect="sensor.gain", attaches="sensor", neutral(gain=1), nests_in={"sensor.nonlinearity"},
    signature="difference in one signal in proportion to it", excitation="large values of the signal",
    reference="Fraden 2016"));
end SensorGain;
