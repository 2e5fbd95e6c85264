within Lacuna.Interfaces;
connector Flange_a "Rotational flange, driving side"
  Types.Angle phi "Absolute angle of the flange";
  flow Types.Torque tau "Cut torque; positive: it drives the component that owns the flange";
  annotation(Documentation(info="<html>
<p>Connected flanges turn together (equal <code>phi</code>) and their torques sum to zero.</p>
</html>"));
end Flange_a;
