within Lacuna.Effects;
model ResistanceImbalance "Resistance of one phase that differs from the others"
  extends Lacuna.Interfaces.TwoPin;
  parameter Types.Resistance dR = 0 "Resistance above the others";
equation
  v = dR*i;
  annotation(__Lacuna(effect="motor.imbalance", attaches="phase", neutral(dR=0),
    signature="voltage in one phase, proportional to its current",
    excitation="current in all phases", reference="Hendershot, Miller 2010"));
end ResistanceImbalance;
