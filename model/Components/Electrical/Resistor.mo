within Lacuna.Components.Electrical;
model Resistor "Ideal resistor"
  extends Interfaces.TwoPin;
  parameter Types.Resistance R(final min=0, start=1) "Resistance";
equation
  v = R*i;
  annotation(Documentation(info="<html>
<p>Law: <code>v = R i</code>. With <code>R = 0</code> it is a short circuit.</p>
</html>"));
end Resistor;
