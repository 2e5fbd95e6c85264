within Lacuna.Interfaces;
partial model Compliant "Two flanges joined by a torque between them, without inertia"
  extends TwoFlanges;
  Types.Angle phi_rel "Angle of flange_b relative to flange_a";
  Types.Torque tau "Torque between the flanges, positive when it pulls flange_b back";
equation
  phi_rel = flange_b.phi - flange_a.phi;
  flange_b.tau = tau;
  flange_a.tau = -tau;
  annotation(Documentation(info="<html>
<p>Use it where torque follows from the relative angle alone.</p>
</html>"));
end Compliant;
