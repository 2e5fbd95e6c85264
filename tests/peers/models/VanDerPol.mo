model VanDerPol "Relaxation oscillator"
  parameter Real mu = 5 "Strength of the nonlinear damping";
  Real x(start=2, fixed=true), y(start=0, fixed=true);
equation
  der(x) = y;
  der(y) = mu*(1 - x^2)*y - x;
  annotation(experiment(StopTime=20, Interval=0.02));
end VanDerPol;
