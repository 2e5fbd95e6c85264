model SquareWaveServo "DC motor on a square wave, with dry friction that sticks"
  parameter Real R(unit="Ohm") = 3.5 "Winding resistance";
  parameter Real L(unit="H") = 3.3e-3 "Winding inductance";
  parameter Real Ke(unit="N.m/A") = 0.03 "Torque and back-EMF constant";
  parameter Real J(unit="kg.m2") = 7e-6 "Inertia";
  parameter Real b(unit="N.m.s/rad") = 2e-5 "Viscous friction";
  parameter Real tauc(unit="N.m") = 2e-3 "Dry friction, sticking and sliding";
  parameter Real U(unit="V") = 12 "Amplitude of the supply";
  parameter Real Th(unit="s") = 0.1 "Half period of the supply";
  Real i(unit="A", start=0, fixed=true) "Current";
  Real w(unit="rad/s", start=0, fixed=true) "Speed";
  Real tau(unit="N.m") "Torque left for friction and acceleration";
  Real tf(unit="N.m") "Friction torque";
  discrete Real s(start=1, fixed=true) "Sign of the supply";
  Integer mode(start=0, fixed=true) "-1 backward, 0 stuck, 1 forward";
equation
  L*der(i) = s*U - R*i - Ke*w;
  tau = Ke*i - b*w;
  J*der(w) = tau - tf;
  tf = if mode == 0 then tau else mode*tauc;
  when sample(Th, Th) then
    s = -pre(s);
  end when;
algorithm
  when pre(mode) == 0 and Ke*i > tauc then
    mode := 1;
  elsewhen pre(mode) == 0 and Ke*i < -tauc then
    mode := -1;
  elsewhen pre(mode) == 1 and w < 0 or pre(mode) == -1 and w > 0 then
    mode := if Ke*i > tauc then 1 elseif Ke*i < -tauc then -1 else 0;
  end when;
  annotation(experiment(StopTime=10, Interval=1e-3));
end SquareWaveServo;
