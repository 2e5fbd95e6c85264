within Lacuna.Components.Mechanics;
model TranslationalDamper "Linear damper between two sliding bodies"
  extends Interfaces.TranslationalCompliant;
  parameter Types.Damping d(final min=0, start=1) "Damping constant";
  Types.Velocity v_rel "Speed of flange_b relative to flange_a";
equation
  v_rel = der(s_rel);
  f = d*v_rel;
  annotation(Documentation(info="<html>
<p>Law: <code>f = d v_rel</code>.</p>
</html>"));
end TranslationalDamper;
