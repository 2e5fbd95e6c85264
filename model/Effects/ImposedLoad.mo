within Lacuna.Effects;
model ImposedLoad "Constant force of a device"
  extends Lacuna.Interfaces.ImposedMotion;
  parameter Types.Force F_0 = 0 "Force";
equation
  f = F_0;
  annotation(__Lacuna(effect="load.constant", attaches="imposed", neutral(F_0=0), nests_in={"stiffness", "friction.asymmetric"},
    signature="constant force", excitation="both directions", reference="Olsson, Astrom, Canudas de Wit, Gafvert, Lischinsky 1998"));
end ImposedLoad;
