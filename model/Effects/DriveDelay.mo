within Lacuna.Effects;
block DriveDelay "Transport delay of the drive or bus, as a chain of equal lags"
  extends Lacuna.Interfaces.SISO;
  parameter Types.Time T_d(final min=1e-6) = 1e-3 "Delay";
protected
  constant Integer n = 6 "Lags in the chain";
  Real x[n](each start=0) "Chain";
equation
  T_d/n*der(x[1]) = u - x[1];
  for k in 2:n loop
    T_d/n*der(x[k]) = x[k - 1] - x[k];
  end for;
  y = x[n];
  annotation(__Lacuna(effect="drive.delay", attaches="signal", location="drive", starts(T_d={1e-3, 5e-3}),
    signature="effort in proportion to the slope of the command", excitation="steps or fast changes of the command",
    reference="Franklin, Powell, Workman 1998"));
end DriveDelay;
