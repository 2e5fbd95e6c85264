within Lacuna.Components.Electrical;
model Bus "Supply: constant voltage behind a source resistance"
  extends Interfaces.TwoPin;
  parameter Types.Voltage V(start=28) "Open-circuit voltage";
  parameter Types.Resistance R(final min=0) = 0 "Source resistance";
  Types.Power power "Power that the ideal source inside delivers";
  Types.Power loss "Heat in the source resistance";
equation
  v = V + R*i;
  power = -V*i;
  loss = R*i*i;
  annotation(Documentation(info="<html>
<p>Law: <code>v = V + R i</code> with <code>i</code> into the positive pin, so a load that draws current makes the bus
sag.
<code>R = 0</code> is the ideal bus. It takes current back: a braking drive returns energy.</p>
</html>"));
end Bus;
