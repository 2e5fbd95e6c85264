within Lacuna.Effects;
model SupplySagLimit "Source limited by a bus voltage that falls with the current drawn"
  extends Lacuna.Interfaces.TwoPin;
  Lacuna.Interfaces.RealInput u(unit="V") "Commanded voltage";
  parameter Types.Resistance R_s(final min=0) = 0 "Source resistance of the bus";
  parameter Types.Voltage V_0(final min=1e-3) = 24 "Bus voltage without current";
  Types.Voltage bus "Bus voltage";
equation
  bus = V_0 - R_s*noEvent(abs(i));
  v = noEvent(min(max(u, -bus), bus));
  annotation(__Lacuna(effect="drive.supply_sag", attaches="replace", replaces="SignalVoltage", neutral(R_s=0), starts(V_0={1}), relative(V_0="u"), fixed={"V_0"},
    signature="voltage missing under large currents at the highest voltage only", excitation="large currents at the highest voltage", reference="Mohan, Undeland, Robbins 2003"));
end SupplySagLimit;
