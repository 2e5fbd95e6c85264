within Lacuna.Effects;
model DriveDelay "Source that follows its command late: a chain of equal lags"
  extends Lacuna.Interfaces.TwoPin;
  Lacuna.Interfaces.RealInput u(unit="V") "Commanded voltage";
  parameter Types.Time T_d(final min=1e-5) = 1e-3 "Delay";
protected
  constant Integer order = 8 "Lags in the chain";
  Types.Voltage x[order](each start=0, each fixed=true) "Chain";
equation
  T_d/order*der(x[1]) = u - x[1];
  for k in 2:order loop
    T_d/order*der(x[k]) = x[k - 1] - x[k];
  end for;
  v = x[order];
  annotation(__Lacuna(effect="drive.delay", attaches="replace", replaces="SignalVoltage", starts(T_d={1e-3, 4e-3}),
    signature="effort in proportion to the slope of the command", excitation="steps or fast changes of the command",
    reference="Franklin, Powell, Workman 1998"));
end DriveDelay;
