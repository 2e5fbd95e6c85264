within Lacuna.Components.Electrical;
model Capacitor "Ideal capacitor"
  extends Interfaces.TwoPin;
  parameter Types.Capacitance C(final min=1e-15, start=1e-6) "Capacitance";
equation
  C*der(v) = i;
  annotation(Documentation(info="<html>
<p>Law: <code>C der(v) = i</code>; <code>v</code> is a state.</p>
</html>"));
end Capacitor;
