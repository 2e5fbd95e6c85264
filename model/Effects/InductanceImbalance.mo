within Lacuna.Effects;
model InductanceImbalance "Inductance of one phase that differs from the others"
  extends Lacuna.Interfaces.TwoPin;
  parameter Types.Inductance dL = 0 "Inductance above the others";
equation
  v = dL*der(i);
  annotation(__Lacuna(effect="motor.imbalance", attaches="phase", neutral(dL=0),
    signature="voltage in one phase, proportional to the slope of its current",
    excitation="fast changes of the current in all phases", reference="Hendershot, Miller 2010"));
end InductanceImbalance;
