model CartesianPendulum "A pendulum in Cartesian coordinates: index 3, a nonlinear constraint"
  parameter Real l(unit="m") = 1 "Length";
  parameter Real m(unit="kg") = 1 "Mass";
  parameter Real g(unit="m/s2") = 9.81 "Gravity";
  Real x(unit="m", start=0.5, fixed=true), y(unit="m", start=-0.866), vx(unit="m/s", start=0, fixed=true), vy(unit="m/s");
  Real F(unit="N") "Force in the rod, positive in tension";
equation
  der(x) = vx;
  der(y) = vy;
  m*der(vx) = -F*x/l;
  m*der(vy) = -F*y/l - m*g;
  x^2 + y^2 = l^2;
  annotation(experiment(StopTime=2, Interval=0.01));
end CartesianPendulum;
