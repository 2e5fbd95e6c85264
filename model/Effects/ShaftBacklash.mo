within Lacuna.Effects;
model ShaftBacklash "Play between two parts of a shaft that is believed rigid"
  extends Interfaces.SplitInertia;
  parameter Types.Angle play(final min=0) = 0.1 "Free travel from one contact to the other";
  parameter Types.RotationalStiffness c(final min=0) = 1 "Stiffness in contact";
  parameter Types.RotationalDamping d(final min=0) = 0 "Damping in contact";
  constant Types.AngularVelocity unit_w = 1;
  Types.RotationalStiffness c_unit = J*unit_w*unit_w "Stiffness that makes the whole inertia swing at 1 rad/s";
  Types.RotationalDamping d_unit = J*unit_w "Damping that stops the whole inertia within 1 s";
equation
  tau_b = if phi_rel > play/2 then max(c*(phi_rel - play/2) + d*w_rel, 0)
    elseif phi_rel < -play/2 then min(c*(phi_rel + play/2) + d*w_rel, 0) else 0;
  annotation(__Lacuna(effect="backlash", attaches="flange", signals(J="inertia"),
    starts(play={0.03, 0.3}, c={4e4}, d={15}, share={0.5}), relative(c="c_unit", d="d_unit"),
    signature="part of the inertia missing for a moment at every reversal of the torque, then a shock",
    excitation="reversals of the torque", reference="Nordin, Gutman 2002"));
end ShaftBacklash;
