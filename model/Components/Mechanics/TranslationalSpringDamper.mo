within Lacuna.Components.Mechanics;
model TranslationalSpringDamper "Linear spring and damper in parallel, between two sliding bodies"
  extends Interfaces.TranslationalCompliant;
  parameter Types.Stiffness c(final min=0, start=1e6) "Stiffness";
  parameter Types.Damping d(final min=0) = 0 "Damping constant";
  Types.Velocity v_rel "Speed of flange_b relative to flange_a";
  Types.Power loss "Heat";
  Types.Energy stored "Elastic energy";
equation
  v_rel = der(s_rel);
  f = c*s_rel + d*v_rel;
  loss = d*v_rel*v_rel;
  stored = c*s_rel*s_rel/2;
  annotation(Documentation(info="<html>
<p>Law: <code>f = c s_rel + d v_rel</code>.</p>
</html>"));
end TranslationalSpringDamper;
