within Lacuna.Effects;
model ImposedBacklash "Dry friction of a device behind a play"
  extends Lacuna.Interfaces.ImposedMotion;
  parameter Types.Force F_c(final min=0) = 0 "Level of full sliding";
  parameter Types.Stiffness k(final min=1) = 1e6 "Stiffness of the contact";
  parameter Types.Length play(final min=0) = 0 "Free travel at every reversal";
  Types.Length x(start=0, fixed=true) "Position in the play, beyond its ends the deflection";
equation
  der(x) = noEvent(if x > play/2 + F_c/k and v > 0 or x < -play/2 - F_c/k and v < 0 then 0 else v);
  f = noEvent(if x > play/2 then k*(x - play/2) elseif x < -play/2 then k*(x + play/2) else 0);
  annotation(__Lacuna(effect="backlash", attaches="imposed", starts(F_c={300, 1000, 3000}, k={1e5, 1e6}, play={0.05, 0.2, 0.6}), relative(play="s"),
    signature="force that returns only after some travel at every reversal", excitation="reversals at several amplitudes", reference="Olsson, Astrom, Canudas de Wit, Gafvert, Lischinsky 1998"));
end ImposedBacklash;
