within Lacuna.Components.Electrical;
model ConstantVoltage "Ideal source of constant voltage"
  extends Interfaces.TwoPin;
  parameter Types.Voltage V(start=28) "Voltage from p to n";
equation
  v = V;
  annotation(Documentation(info="<html>
<p>Law: <code>v = V</code> whatever the current, in either direction. It delivers the power <code>-v i</code>.</p>
</html>"));
end ConstantVoltage;
