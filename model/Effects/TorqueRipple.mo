within Lacuna.Effects;
model TorqueRipple "Torque periodic in the rotor's angle and proportional to the torque of the machine"
  extends Interfaces.FlangeEffect;
  Lacuna.Interfaces.RealInput drive_torque(unit="N.m") "Torque that the current makes";
  parameter Types.PerUnit amplitude(final min=0) = 0 "Amplitude over the torque of the machine";
  parameter Real periods(final min=1) = 6 "Periods a turn";
  parameter Types.Angle phase = 0 "Phase at angle zero";
equation
  tau = -amplitude*drive_torque*sin(periods*angle + phase);
  annotation(__Lacuna(effect="torque.ripple", attaches="flange", neutral(amplitude=0), polar={"amplitude", "phase"},
    signals(drive_torque="motor"), whole={"periods"},
    starts(periods={2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 15, 16, 18, 20, 21, 24, 28, 30, 36, 42, 48}),
    signature="effort of a whole number of periods a turn whose size follows the current",
    excitation="slow rotation over several turns under different loads", reference="Hendershot, Miller 2010"));
end TorqueRipple;
