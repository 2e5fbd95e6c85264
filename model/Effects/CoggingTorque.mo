within Lacuna.Effects;
model CoggingTorque "Torque periodic in the rotor's angle, without current"
  extends Interfaces.FlangeEffect;
  parameter Types.Torque amplitude(final min=0) = 0 "Amplitude";
  parameter Real periods(final min=1) = 6 "Periods a turn";
  parameter Types.Angle phase = 0 "Phase at angle zero";
equation
  tau = amplitude*sin(periods*angle + phase);
  annotation(__Lacuna(effect="torque.cogging", attaches="flange", neutral(amplitude=0), polar={"amplitude", "phase"},
    starts(periods={2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 15, 16, 18, 20, 21, 24, 28, 30, 36, 42, 48}), whole={"periods"},
    signature="effort of a whole number of periods a turn, with and without current",
    excitation="slow rotation over several turns", reference="Hendershot, Miller 2010"));
end CoggingTorque;
