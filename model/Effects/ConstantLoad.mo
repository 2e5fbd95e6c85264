within Lacuna.Effects;
model ConstantLoad "Constant load torque"
  extends Interfaces.FlangeEffect;
  parameter Types.Torque tau_0 = 0 "Torque against positive speed";
equation
  tau = tau_0;
  annotation(__Lacuna(effect="load.constant", attaches="flange", neutral(tau_0=0),
    nests_in={"stiffness", "load.gravity", "friction.asymmetric"},
    signature="constant effort, also at rest", excitation="both directions", reference="statics"));
end ConstantLoad;
