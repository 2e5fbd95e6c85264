model Dahlquist "Decay"
  parameter Real k(unit="1/s") = 1 "Rate";
  output Real x(start=1, fixed=true);
equation
  der(x) = -k*x;
  annotation(experiment(StopTime=10, Interval=0.1));
end Dahlquist;
