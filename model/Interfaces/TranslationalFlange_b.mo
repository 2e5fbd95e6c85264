within Lacuna.Interfaces;
connector TranslationalFlange_b "Translational flange, driven side"
  Types.Length s "Absolute position of the flange";
  flow Types.Force f "Cut force; positive: it drives the component that owns the flange";
  annotation(Documentation(info="<html>
<p>Connected flanges move together (equal <code>s</code>) and their forces sum to zero.</p>
</html>"));
end TranslationalFlange_b;
