model Clockwork "A controller with samples and a limit, an input and a stop: every kind of event"
  input Real u(unit="N.m") "Torque";
  parameter Real J(unit="kg.m2", min=1e-6) = 0.5 "Inertia";
  parameter Real b(unit="N.m.s/rad") = 0.2 "Friction";
  parameter Real c(unit="N.m/rad") = 3 "Stiffness of the stop";
  parameter Real stop(unit="rad") = 1 "Where it begins";
  parameter Real T(unit="s") = 0.1 "Interval of the samples";
  parameter Real kick(unit="rad/s") = 0.3 "Speed given at half a second";
  final parameter Real twice(unit="kg.m2") = 2*J;
  Real phi(unit="rad", start=0, fixed=true), w(unit="rad/s", start=1, fixed=true);
  discrete Real seen(unit="rad", start=0, fixed=true) "Angle at the last sample";
  output Real power(unit="W");
equation
  der(phi) = w;
  J*der(w) = u - b*w - (if phi > stop then c*(phi - stop) else 0);
  power = u*w;
  when sample(T, T) then
    seen = phi;
  end when;
  when time >= 0.5 then
    reinit(w, pre(w) + kick);
  end when;
  annotation(experiment(StopTime=2, Interval=0.01));
end Clockwork;
