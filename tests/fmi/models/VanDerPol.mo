model VanDerPol "Oscillator that limits itself"
  parameter Real mu = 1 "How strongly";
  output Real x0(start=2, fixed=true), x1(start=0, fixed=true);
equation
  der(x0) = x1;
  der(x1) = mu*((1 - x0^2)*x1) - x0;
  annotation(experiment(StopTime=20, Interval=0.1));
end VanDerPol;
