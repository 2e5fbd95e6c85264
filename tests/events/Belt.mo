model Belt "A mass held by a spring and a damper rides on a moving belt: it sticks, breaks away, slips back, sticks again"
  parameter Real m(unit="kg") = 1;
  parameter Real k(unit="N/m") = 100 "spring";
  parameter Real d(unit="N.s/m") = 0.5 "damper";
  parameter Real vBelt(unit="m/s") = 0.1;
  parameter Real Fs(unit="N") = 12 "friction breaks away at";
  parameter Real Fc(unit="N") = 8 "friction while slipping";
  Real x(unit="m", start=0, fixed=true) "position, from the spring at rest";
  Real v(unit="m/s");
  Real f(unit="N") "friction";
  Boolean stuck(start=true, fixed=true);
initial equation
  v = vBelt;
equation
  der(x) = v;
  m*der(v) = f - k*x - d*v;
  f = if stuck then k*x + d*v else Fc;
  when pre(stuck) and k*x + d*v > Fs then
    stuck = false;
  elsewhen not pre(stuck) and v > vBelt and k*x + d*v < Fc then
    stuck = true;
  end when;
  annotation(experiment(StopTime=10));
end Belt;
