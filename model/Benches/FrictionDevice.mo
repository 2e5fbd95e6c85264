within Lacuna.Benches;
model FrictionDevice "Device whose motion is imposed and whose resisting force is measured"
  parameter Types.Damping c(final min=0) = 1e5 "Damping constant";
  input Types.Length x "Imposed displacement";
  input Types.Velocity v "Its derivative, recorded beside it";
  replaceable Components.Mechanics.ImposedDamper device(d=c) "Device under test";
  Types.Force F = device.f "Resisting force";
equation
  device.s = x;
  device.v = v;
  annotation(experiment(StopTime=1, Tolerance=1e-6), Documentation(info="<html>
<pre>
F = c v      device
</pre>
<p>Displacement and speed are both recorded, so nothing is differentiated and the bench has no states of its own;
those of
an effect in <code>device</code> would be the only ones.</p>
</html>"));
end FrictionDevice;
