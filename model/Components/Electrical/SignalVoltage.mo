within Lacuna.Components.Electrical;
model SignalVoltage "Ideal source whose voltage is an input signal"
  extends Interfaces.TwoPin;
  Interfaces.RealInput u(unit="V") "Voltage from p to n";
equation
  v = u;
  annotation(Documentation(info="<html>
<p>Law: <code>v = u</code> whatever the current, in either direction.</p>
</html>"));
end SignalVoltage;
