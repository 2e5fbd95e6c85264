within Lacuna.Components.Drives;
model AveragedBridge "Three-phase bridge, averaged over the period of its modulation"
  extends Interfaces.PartialBridge;
  Interfaces.IntegerInput leg[3] "Sense in which each leg is modulated: 1, -1, or 0 floating";
  Interfaces.RealInput duty(unit="1") "Duty, -1 to 1";
  AveragedHalfBridge leg_a "Leg of phase a";
  AveragedHalfBridge leg_b "Leg of phase b";
  AveragedHalfBridge leg_c "Leg of phase c";
equation
  connect(p, leg_a.p);
  connect(p, leg_b.p);
  connect(p, leg_c.p);
  connect(n, leg_a.n);
  connect(n, leg_b.n);
  connect(n, leg_c.n);
  connect(leg_a.out, a);
  connect(leg_b.out, b);
  connect(leg_c.out, c);
  connect(leg[1], leg_a.u);
  connect(leg[2], leg_b.u);
  connect(leg[3], leg_c.u);
  connect(duty, leg_a.duty);
  connect(duty, leg_b.duty);
  connect(duty, leg_c.duty);
  annotation(Documentation(info="<html>
<p>The pair of driven legs puts <code>duty</code> times the bus voltage across its two phases; the third leg floats
with its
diodes, as in <code>Bridge</code>. <code>duty = 1</code> is full voltage.</p>
</html>"));
end AveragedBridge;
