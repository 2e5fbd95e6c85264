within Lacuna.Components.Electrical;
model Ground "Reference potential of a circuit"
  Interfaces.PositivePin p "Pin held at zero potential";
equation
  p.v = 0;
  annotation(Documentation(info="<html>
<p>Law: <code>p.v = 0</code>. One in each circuit: with none, potentials are undetermined; its current is then whatever
closes Kirchhoff's law, which is zero in a correct circuit.</p>
</html>"));
end Ground;
