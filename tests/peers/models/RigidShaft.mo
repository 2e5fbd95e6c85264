model RigidShaft "Two inertias on one shaft through an ideal gear: index 3"
  parameter Real J1(unit="kg.m2") = 2e-3 "Motor side";
  parameter Real J2(unit="kg.m2") = 0.1 "Load side";
  parameter Real ratio(unit="1") = 5 "Reduction";
  parameter Real d(unit="N.m.s/rad") = 0.2 "Damping of the load";
  parameter Real T(unit="N.m") = 0.5 "Motor torque";
  Real phi1(unit="rad"), w1(unit="rad/s"), phi2(unit="rad", start=0, fixed=true), w2(unit="rad/s", start=0, fixed=true);
  Real tau1(unit="N.m") "Gear on the motor", tau2(unit="N.m") "Gear on the load";
equation
  der(phi1) = w1;
  der(phi2) = w2;
  J1*der(w1) = T - tau1;
  J2*der(w2) = tau2 - d*w2;
  phi1 = ratio*phi2;
  tau2 = ratio*tau1;
  annotation(experiment(StopTime=3, Interval=0.01));
end RigidShaft;
