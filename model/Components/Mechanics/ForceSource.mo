within Lacuna.Components.Mechanics;
model ForceSource "Force on a sliding flange, from a signal"
  Interfaces.RealInput u(unit="N") "Force that drives the flange";
  Interfaces.TranslationalFlange_b flange "Driven flange";
  Types.Power power "Power given to the flange";
equation
  flange.f = -u;
  power = u*der(flange.s);
  annotation(Documentation(info="<html>
<p>Law: force <code>u</code> on whatever is connected, positive in the sense of the position.</p>
</html>"));
end ForceSource;
