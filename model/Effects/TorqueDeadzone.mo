within Lacuna.Effects;
model TorqueDeadzone "Torque source that passes commands only beyond a threshold"
  Lacuna.Interfaces.RealInput u(unit="N.m") "Commanded torque";
  Lacuna.Interfaces.Flange_b flange "Driven flange";
  parameter Types.Torque width(final min=0) = 0 "Threshold of the command";
  constant Real edge = 0.0005 "Half width of the transition, in thresholds";
equation
  flange.tau = noEvent(if abs(u) >= (1 + edge)*width then -u elseif abs(u) <= (1 - edge)*width then 0 else -u*(abs(u) - (1 - edge)*width)/(2*edge*width));
  annotation(__Lacuna(effect="drive.deadband", attaches="replace", replaces="TorqueSource",
    starts(width={0.02, 0.03, 0.045, 0.065, 0.1, 0.14, 0.2, 0.28, 0.4}), relative(width="u"),
    signature="effort equal to the command while it is small", excitation="small commands", reference="Tao, Kokotovic 1996"),
    Documentation(info="<html>
<p>The transition is narrow but no step: around a step a control loop would switch infinitely often.</p>
</html>"));
end TorqueDeadzone;
