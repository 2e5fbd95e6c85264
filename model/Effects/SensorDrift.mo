within Lacuna.Effects;
block SensorDrift "Sensor whose zero drifts"
  extends Lacuna.Interfaces.SISO;
  parameter Real drift = 0 "Change of its zero in a second";
  Real error(start=0, fixed=true) "Of the zero since the start";
equation
  der(error) = drift;
  y = u + error;
  annotation(__Lacuna(effect="sensor.drift", attaches="sensor", neutral(drift=0),
    signature="difference in one signal that grows with time", excitation="none", reference="Fraden 2016"));
end SensorDrift;
