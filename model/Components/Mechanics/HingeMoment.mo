within Lacuna.Components.Mechanics;
model HingeMoment "Aerodynamic moment on a control surface"
  parameter Types.Torque tau0 = 0 "Constant part, against positive deflection";
  parameter Types.RotationalStiffness c = 0 "Moment for one radian of deflection";
  Interfaces.RealInput u(unit="N.m") "Further part, from a signal";
  Interfaces.Flange_a flange "Surface";
  Types.Torque tau "Moment against positive deflection";
  Types.Power delivered "Power given to the air";
equation
  tau = tau0 + c*flange.phi + u;
  flange.tau = tau;
  delivered = tau*der(flange.phi);
  annotation(Documentation(info="<html>
<p>Law: <code>tau0 + c phi + u(t)</code>, opposing positive deflection: constant, proportional to deflection, and
recorded
or commanded in time (connect a <code>Sources.CsvTable</code> to <code>u</code>). A negative <code>c</code> is an
overbalanced surface.</p>
</html>"));
end HingeMoment;
