within Lacuna.Components.Drives;
model AveragedHalfBridge "One leg of an inverter, averaged over the period of its modulation"
  extends Interfaces.PartialLeg;
  Interfaces.IntegerInput u "Sense in which the leg is modulated: 1 or -1; 0: both switches open";
  Interfaces.RealInput duty(unit="1") "Duty, -1 to 1: potential between the negative and the positive rail";
equation
  driven = u <> 0;
  share = (1 + u*duty)/2;
  annotation(Documentation(info="<html>
<p>Mean of a leg that is switched much faster than the current changes: potential and rail currents are those of the two
switches, weighted by their shares of the period. Lossless, as power <code>v i</code> is what the rails give. When not
driven it is <code>HalfBridge</code>.</p>
</html>"));
end AveragedHalfBridge;
