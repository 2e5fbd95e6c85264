within Lacuna.Interfaces;
partial model TwoFlanges "Component with two flanges"
  Flange_a flange_a "Left flange";
  Flange_b flange_b "Right flange";
  annotation(Documentation(info="<html>
<p>Use it when neither <code>Rigid</code> nor <code>Compliant</code> applies, as for gears.</p>
</html>"));
end TwoFlanges;
