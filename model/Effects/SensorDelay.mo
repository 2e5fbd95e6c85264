within Lacuna.Effects;
block SensorDelay "Delay of a sensor"
  extends Lacuna.Interfaces.SISO;
  parameter Types.Time T_d(final min=0) = 1e-3 "Delay";
  parameter Types.Time interval(final min=0) = 1e-3 "Time between the samples that are kept";
protected
  Interfaces.SampledDelay bus(T_d=T_d, interval=interval) "Way of the reading";
equation
  bus.u = u;
  y = bus.late;
  annotation(__Lacuna(effect="sensor.lag", attaches="sensor", starts(T_d={1, 3, 10, 30}), relative(T_d="interval"),
    interval="interval",
    signature="one signal as believed, but later", excitation="fast changes of the signal",
    reference="Franklin, Powell, Workman 1998"));
end SensorDelay;
