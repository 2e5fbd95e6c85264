within Lacuna.Effects;
model Backlash "Elastic transmission with play"
  extends Lacuna.Interfaces.CompliantWithSpeed;
  parameter Types.RotationalStiffness c(final min=0, start=1) "Stiffness";
  parameter Types.RotationalDamping d(final min=0, start=0) "Damping constant";
  parameter Types.Angle phi_rel0 = 0 "Middle of the play";
  parameter Types.Angle play(final min=0) = 0 "Free travel from one contact to the other";
  Types.Angle gap "Relative angle from the middle of the play";
equation
  gap = phi_rel - phi_rel0;
  tau = if gap > play/2 then max(c*(gap - play/2) + d*w_rel, 0)
    elseif gap < -play/2 then min(c*(gap + play/2) + d*w_rel, 0) else 0;
  annotation(__Lacuna(effect="backlash", attaches="replace", replaces="SpringDamper", neutral(play=0),
    starts(play={0.3, 1, 3}), relative(play="gap"),
    signature="no effort within a small relative angle, at reversals of the load",
    excitation="reversals of the transmitted torque", reference="Nordin, Gutman 2002"));
end Backlash;
