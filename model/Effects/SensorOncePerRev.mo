within Lacuna.Effects;
block SensorOncePerRev "Error of an angle sensor periodic in the angle"
  extends Lacuna.Interfaces.SISO(u(unit="rad"), y(unit="rad"));
  parameter Types.Angle amplitude(final min=0) = 0 "Amplitude of the error";
  parameter Real periods(final min=1) = 1 "Periods a turn: one of a disc off its centre, two of windings that differ";
  parameter Types.Angle phase = 0 "Phase at angle zero";
  parameter Types.Angle zero = 0 "Reading at angle zero, without the error: it was zeroed with it";
equation
  y = u + amplitude*sin(periods*u + phase) + zero;
  annotation(__Lacuna(effect="sensor.once_per_rev", attaches="sensor", unit="rad", neutral(amplitude=0, zero=0),
    polar={"amplitude", "phase"}, starts(periods={1, 2}), whole={"periods"},
    signature="difference in one angle signal, one or two periods a turn",
    excitation="several turns", reference="Hanselman 1990"));
end SensorOncePerRev;
