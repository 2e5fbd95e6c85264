within Lacuna.Effects;
block SensorOncePerRev "Error of an angle sensor periodic in the angle"
  extends Lacuna.Interfaces.SISO(u(unit="rad"), y(unit="rad"));
  parameter Types.Angle amplitude(final min=0) = 0 "Amplitude of the error";
  parameter Types.Angle phase = 0 "Phase at angle zero";
equation
  y = u + amplitude*sin(u + phase);
  annotation(__Lacuna(effect="sensor.once_per_rev", attaches="sensor", unit="rad", neutral(amplitude=0), polar={"amplitude", "phase"},
    signature="difference in one angle signal, one period a turn", excitation="several turns", reference="Hanselman 1990"));
end SensorOncePerRev;
