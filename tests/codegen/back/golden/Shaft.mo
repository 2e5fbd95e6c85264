model Shaft "two rigidly coupled inertias with a drive that saturates"
  parameter Real J1(unit = "kg.m2", min = 1e-9) = 2;
  parameter Real J2(unit = "kg.m2") = 3;
  parameter Real ratio = 4;
  parameter Real k(unit = "N.m.s") = 5 "Gain of the speed loop";
  parameter Real tau_max(unit = "N.m") = 10;
  parameter Real w_ref(unit = "1/s") = 1;
  Real phi1(start = 0, fixed = true);
  Real phi2;
  Real w1(unit = "1/s", start = 0, fixed = true);
  Real w2(unit = "1/s");
  Real drive(unit = "N.m");
  Real tau(unit = "N.m");
equation
  w1 = der(phi1);
  w2 = der(phi2);
  phi1 = ratio*phi2;
  drive = min(k*(w_ref - w1), tau_max);
  J1*der(w1) = drive - tau;
  J2*der(w2) = ratio*tau;
end Shaft;
