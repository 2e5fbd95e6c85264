within Lacuna.Effects;
block SensorLeak "Sensor that forgets a steady value"
  extends Lacuna.Interfaces.SISO;
  parameter Types.Time T(final min=0) = 1e30 "Time constant";
  Real z(start=0, fixed=true) "What has leaked away since the start";
equation
  T*der(z) = u - z;
  y = u - z;
  annotation(__Lacuna(effect="sensor.leak", attaches="sensor", starts(T={0.01, 0.1, 1}), relative(T="duration"),
    signature="difference in one signal that grows while it is held", excitation="values that are held",
    reference="Fraden 2016"));
end SensorLeak;
