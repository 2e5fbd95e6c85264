model Late "Two delays: of a state and of a step"
  parameter Real T(unit = "s") = 0.3 "Delay";
  parameter Real k(unit = "1/s") = 2 "Gain";
  Real x(start = 1, fixed = true) "Controlled by its past";
  Real z(start = 0, fixed = true) "Moved by a late step";
equation
  der(x) = -k*delay(x, T);
  der(z) = k*(delay(if time > 0.5 then 1.0 else 0.0, 0.25) - z);
  annotation(experiment(StopTime = 3));
end Late;
