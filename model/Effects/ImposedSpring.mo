within Lacuna.Effects;
model ImposedSpring "Spring of a device"
  extends Lacuna.Interfaces.ImposedMotion;
  parameter Types.Stiffness k = 0 "Stiffness";
  parameter Types.Length s_0 = 0 "Position without force";
equation
  f = k*(s - s_0);
  annotation(__Lacuna(effect="stiffness", attaches="imposed", neutral(k=0), nests_in={"backlash"},
    signature="force proportional to position", excitation="two amplitudes", reference="Olsson, Astrom, Canudas de Wit, Gafvert, Lischinsky 1998"));
end ImposedSpring;
