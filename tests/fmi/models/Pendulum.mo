model Pendulum "No pair of its variables can be the states for a whole swing"
  parameter Real L(unit="m") = 1;
  parameter Real g(unit="m/s2") = 9.81;
  Real x(unit="m", start=1, fixed=true);
  Real y(unit="m", start=0);
  Real vx(unit="m/s", start=0);
  Real vy(unit="m/s", start=0, fixed=true);
  Real pull(unit="1/s2");
equation
  der(x) = vx;
  der(y) = vy;
  der(vx) = -pull*x;
  der(vy) = -pull*y - g;
  x^2 + y^2 = L^2;
  annotation(experiment(StopTime=4));
end Pendulum;
