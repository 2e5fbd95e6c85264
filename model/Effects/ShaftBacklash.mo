within Lacuna.Effects;
model ShaftBacklash "Play between two parts of a shaft that is believed rigid"
  extends Interfaces.SplitInertia;
  parameter Types.Angle play(final min=0) = 0.1 "Free travel from one contact to the other";
  parameter Types.RotationalStiffness c(final min=0) = 1 "Stiffness in contact";
  parameter Types.RotationalDamping d(final min=0) = 0 "Damping in contact";
  constant Types.AngularVelocity unit_w = 1;
  Types.RotationalStiffness c_unit = J*unit_w*unit_w "Stiffness that makes the whole inertia swing at 1 rad/s";
  Types.RotationalDamping d_unit = J*unit_w "Damping that stops the whole inertia within 1 s";
  Types.Angle deflection "Deflection of the contact; 0 within the play";
  Types.Torque push "Torque of the flanks on each other";
equation
  deflection = noEvent(if phi_rel > play/2 then phi_rel - play/2 elseif phi_rel < -play/2 then phi_rel + play/2 else 0);
  push = noEvent(min(max(c*abs(deflection) + d*(if deflection > 0 then w_rel else -w_rel), 0), 2*c*abs(deflection)));
  tau_b = noEvent(if deflection > 0 then push else -push);
  annotation(__Lacuna(effect="backlash", attaches="flange", signals(J="inertia"),
    starts(play={0.02, 0.06, 0.15, 0.3, 0.6, 1.2, 3}, c={4e4}, d={15}, share={0.4}), relative(c="c_unit", d="d_unit"),
    signature="part of the inertia missing for a moment at every reversal of the torque, then a shock",
    excitation="reversals of the torque", reference="Nordin, Gutman 2002"),
    Documentation(info="<html>
<p>The damping part is limited to the elastic one, as in <code>Components.Mechanics.Backlash</code>: the torque begins at zero,
never pulls, and has corners but no jumps, so it needs no events.</p>
</html>"));
end ShaftBacklash;
