within Lacuna.Effects;
model ImposedPresliding "Dry friction of a device with elastic micro-motion (Dahl)"
  extends Lacuna.Interfaces.ImposedMotion;
  parameter Types.Force F_c(final min=0) = 0 "Level of full sliding";
  parameter Types.Length x_s(final min=1e-9) = 1e-3 "Micro-motion over which the level builds up";
  parameter Types.PerUnit z_0(final min=-1, final max=1) = 0 "Share of the level at the start";
  Types.PerUnit z(start=0) "Share of the level that is built up";
initial equation
  z = z_0;
equation
  der(z) = (v - noEvent(abs(v))*z)/x_s;
  f = F_c*z;
  annotation(__Lacuna(effect="friction.presliding", attaches="imposed", neutral(F_c=0), fixed={"z_0"}, starts(x_s={0.01, 0.05, 0.2}), relative(x_s="s"),
    signature="hysteresis in position after every reversal", excitation="reversals at several amplitudes", reference="Olsson, Astrom, Canudas de Wit, Gafvert, Lischinsky 1998"));
end ImposedPresliding;
