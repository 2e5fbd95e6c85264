within Lacuna.Components.Drives;
block PairCurrent "Current through the two phases that are driven"
  Interfaces.IntegerInput pattern[3] "1 where the current enters, -1 where it leaves, 0 floating";
  Interfaces.RealInput i[3](each unit="A") "Phase currents";
  Interfaces.RealOutput y(unit="A") "Current of the pair";
equation
  y = (pattern[1]*i[1] + pattern[2]*i[2] + pattern[3]*i[3])/2;
  annotation(Documentation(info="<html>
<p>Mean of what enters one phase and leaves the other: what a six-step drive regulates, positive for positive torque.
While the floating phase still conducts the two differ, and <code>y</code> steps at each commutation.</p>
</html>"));
end PairCurrent;
