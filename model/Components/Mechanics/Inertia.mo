within Lacuna.Components.Mechanics;
model Inertia "Rigid body that turns"
  extends Interfaces.Rigid;
  parameter Types.Inertia J(final min=0, start=1e-5) "Moment of inertia";
  Types.Energy stored "Kinetic energy";
equation
  J*a = flange_a.tau + flange_b.tau;
  stored = J*w*w/2;
  annotation(Documentation(info="<html>
<p>Law: <code>J a = flange_a.tau + flange_b.tau</code>. Rigidly coupled inertias share one angle and one speed; their
constraint is differentiated until it can be solved.</p>
</html>"));
end Inertia;
