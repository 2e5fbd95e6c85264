within Lacuna.Effects;
model BusResistance "Source with a resistance, as a bus that is not stiff"
  extends Lacuna.Interfaces.TwoPin;
  Lacuna.Interfaces.RealInput u(unit="V") "Commanded voltage";
  parameter Types.Resistance R_s(final min=0) = 0 "Source resistance";
equation
  v = u + R_s*i;
  annotation(__Lacuna(effect="drive.supply_sag", attaches="replace", replaces="SignalVoltage", neutral(R_s=0),
    signature="voltage missing in proportion to the current", excitation="currents of different size", reference="Mohan, Undeland, Robbins 2003"));
end BusResistance;
