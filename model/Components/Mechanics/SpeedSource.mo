within Lacuna.Components.Mechanics;
model SpeedSource "Flange that turns at a given speed"
  Interfaces.RealInput u(unit="rad/s") "Speed";
  Interfaces.Flange_b flange "Driven flange";
  Types.Angle phi(start=0, fixed=true, stateSelect=StateSelect.prefer) "Angle";
equation
  flange.phi = phi;
  der(phi) = u;
  annotation(Documentation(info="<html>
<p>Law: <code>der(phi) = u</code> whatever the torque: a belt, a test machine.</p>
</html>"));
end SpeedSource;
