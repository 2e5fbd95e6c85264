within Lacuna.Components.Mechanics;
model ImposedDamper "Linear damper moved by a test machine"
  extends Interfaces.ImposedMotion;
  parameter Types.Damping d(final min=0, start=1) "Damping constant";
equation
  f = d*v;
  annotation(Documentation(info="<html>
<p>Law: <code>f = d v</code>.</p>
</html>"));
end ImposedDamper;
