model ClippedSupply "A sine, clipped, through two low-pass sections"
  parameter Real f(unit="Hz") = 5 "Frequency";
  parameter Real V(unit="V") = 2 "Amplitude";
  parameter Real limit(unit="V") = 1 "Clipping level";
  parameter Real tau(unit="s") = 0.02 "Time constant of a section";
  constant Real pi = 3.141592653589793;
  Real u(unit="V"), c(unit="V"), y1(unit="V", start=0, fixed=true), y2(unit="V", start=0, fixed=true);
equation
  u = V*sin(2*pi*f*time);
  c = if u > limit then limit elseif u < -limit then -limit else u;
  tau*der(y1) = c - y1;
  tau*der(y2) = y1 - y2;
  annotation(experiment(StopTime=1, Interval=1e-3));
end ClippedSupply;
