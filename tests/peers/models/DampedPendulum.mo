model DampedPendulum "Large swings of a damped pendulum"
  parameter Real g(unit="m/s2") = 9.81 "Gravity";
  parameter Real l(unit="m") = 0.5 "Length";
  parameter Real m(unit="kg") = 0.3 "Mass";
  parameter Real d(unit="N.m.s/rad") = 0.01 "Damping";
  Real phi(unit="rad", start=2, fixed=true) "Angle from hanging";
  Real w(unit="rad/s", start=0, fixed=true) "Speed";
equation
  der(phi) = w;
  m*l^2*der(w) = -m*g*l*sin(phi) - d*w;
  annotation(experiment(StopTime=5, Interval=0.01));
end DampedPendulum;
