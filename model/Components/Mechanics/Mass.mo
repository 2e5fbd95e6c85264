within Lacuna.Components.Mechanics;
model Mass "Rigid body that slides"
  parameter Types.Mass m(final min=0, start=1) "Mass";
  Types.Energy stored "Kinetic energy";
  Interfaces.TranslationalFlange_a flange_a "Left flange";
  Interfaces.TranslationalFlange_b flange_b "Right flange";
  Types.Length s(stateSelect=StateSelect.prefer) "Position";
  Types.Velocity v(stateSelect=StateSelect.prefer) "Speed";
  Types.Acceleration a "Acceleration";
equation
  flange_a.s = s;
  flange_b.s = s;
  v = der(s);
  a = der(v);
  m*a = flange_a.f + flange_b.f;
  stored = m*v*v/2;
  annotation(Documentation(info="<html>
<p>Law: <code>m a = flange_a.f + flange_b.f</code>.</p>
</html>"));
end Mass;
