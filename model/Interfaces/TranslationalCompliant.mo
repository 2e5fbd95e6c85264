within Lacuna.Interfaces;
partial model TranslationalCompliant "Two sliding flanges joined by a force between them, without mass"
  TranslationalFlange_a flange_a "Left flange";
  TranslationalFlange_b flange_b "Right flange";
  Types.Length s_rel "Position of flange_b relative to flange_a";
  Types.Force f "Force between the flanges, positive when it pulls flange_b back";
equation
  s_rel = flange_b.s - flange_a.s;
  flange_b.f = f;
  flange_a.f = -f;
  annotation(Documentation(info="<html>
<p>Use it where force follows from the relative position, or from its derivative.</p>
</html>"));
end TranslationalCompliant;
