within Lacuna.Components.Drives;
model Bridge "Three-phase bridge of ideal switches and diodes"
  extends Interfaces.PartialBridge;
  Interfaces.IntegerInput leg[3] "Command of each leg: 1 to the positive rail, -1 to the negative rail, 0 floating";
  HalfBridge leg_a "Leg of phase a";
  HalfBridge leg_b "Leg of phase b";
  HalfBridge leg_c "Leg of phase c";
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
  annotation(Documentation(info="<html>
<p>Lossless: the power taken from the rails is the power given to the load. What a real bridge loses is added at its
pins
(a resistance in a line, a source resistance at the rails).</p>
</html>"));
end Bridge;
