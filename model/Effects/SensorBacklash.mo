within Lacuna.Effects;
block SensorBacklash "Sensor that follows through a play"
  extends Lacuna.Interfaces.SISO;
  parameter Real gap(final min=0) = 0 "Way to either side before it follows";
  parameter Types.Time interval(final min=0) = 1e-3 "Time between the samples";
  Real x "Middle of the play, which follows at once where it is taken along";
  Real free "Way in the play";
  // the middle follows within a tenth of the time between samples: what is quicker is not seen
initial equation
  x = u;
equation
  free = noEvent(min(max(u - x, -gap), gap));
  interval/10*der(x) = u - x - free;
  y = u - free;
  annotation(__Lacuna(effect="sensor.backlash", attaches="sensor", neutral(gap=0), interval="interval",
    signature="one signal as believed, late by a fixed way after every reversal", excitation="reversals at several amplitudes",
    reference="Fraden 2016"));
end SensorBacklash;
