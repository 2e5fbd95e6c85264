within Lacuna.Effects;
block SensorBacklash "Sensor that follows through a play"
  extends Lacuna.Interfaces.SISO;
  parameter Real gap(final min=0) = 0 "Way to either side before it follows";
  parameter Types.Time interval(final min=0) = 1e-3 "Time between the samples";
  Real x "Reading";
initial equation
  x = u;
equation
  interval/10*der(x) = noEvent(u - x - min(max(u - x, -gap), gap));
  y = x;
  annotation(__Lacuna(effect="sensor.backlash", attaches="sensor", neutral(gap=0), interval="interval",
    signature="one signal as believed, late by a fixed way after every reversal", excitation="reversals at several amplitudes",
    reference="Fraden 2016"));
end SensorBacklash;
