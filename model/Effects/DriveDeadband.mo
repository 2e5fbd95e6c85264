within Lacuna.Effects;
block DriveDeadband "No output for small commands"
  extends Lacuna.Interfaces.SISO;
  parameter Real band(final min=0) = 0 "Half width of the band without output";
equation
  y = noEvent(if u > band then u - band elseif u < -band then u + band else 0);
  annotation(__Lacuna(effect="drive.deadband", attaches="signal", location="drive", neutral(band=0),
    signature="effort with the sign of the command, nothing for small commands",
    excitation="slow passage of the command through zero", reference="Tao, Kokotovic 1996"));
end DriveDeadband;
