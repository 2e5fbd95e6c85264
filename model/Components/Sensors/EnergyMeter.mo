within Lacuna.Components.Sensors;
block EnergyMeter "Energy from a power"
  Interfaces.RealInput power(unit="W") "Power";
  Types.Energy E(start=0, fixed=true) "Energy since the start";
equation
  der(E) = power;
  annotation(Documentation(info="<html>
<p>Law: <code>der(E) = power</code>. It is integrated with the model and under the same error control, so a balance of
meters
closes to the solver's tolerance.</p>
</html>"));
end EnergyMeter;
