within Lacuna.Components.Mechanics;
model TranslationalFixed "Sliding flange fixed in the housing"
  parameter Types.Length s0 = 0 "Position at which it is fixed";
  Interfaces.TranslationalFlange_b flange "Fixed flange";
equation
  flange.s = s0;
  annotation(Documentation(info="<html>
<p>Law: <code>s = s0</code>; it takes any force.</p>
</html>"));
end TranslationalFixed;
