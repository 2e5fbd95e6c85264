within Lacuna.Effects;
block SensorLag "Bandwidth of a sensor"
  extends Lacuna.Interfaces.SISO;
  parameter Types.Time T(final min=0) = 1e-3 "Time constant";
  Real x "Reading";
initial equation
  x = u;
equation
  T*der(x) = u - x;
  y = x;
  annotation(__Lacuna(effect="sensor.lag", attaches="sensor", starts(T={0.3, 3, 30, 300, 3000}), relative(T="interval"),
    signature="difference in one signal in proportion to its slope", excitation="fast changes of the signal",
    reference="Fraden 2016"));
end SensorLag;
