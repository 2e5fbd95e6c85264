within Lacuna.Components.Mechanics;
model Fixed "Flange fixed in the housing"
  parameter Types.Angle phi0 = 0 "Angle at which it is fixed";
  Interfaces.Flange_b flange "Fixed flange";
equation
  flange.phi = phi0;
  annotation(Documentation(info="<html>
<p>Law: <code>phi = phi0</code>; it takes any torque.</p>
</html>"));
end Fixed;
