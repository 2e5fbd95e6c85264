model SampledController "A discrete PI law that holds its output between samples"
  parameter Real tau(unit="s") = 0.5 "Time constant of the plant";
  parameter Real Ts(unit="s") = 0.05 "Sampling period";
  parameter Real kp(unit="1") = 2 "Proportional gain";
  parameter Real ki(unit="1/s") = 3 "Integral gain";
  Real y(start=0, fixed=true) "Plant";
  discrete Real u(start=0, fixed=true) "Held command";
  discrete Real s(start=0, fixed=true) "Sum of the errors";
equation
  tau*der(y) = u - y;
  when sample(0, Ts) then
    s = pre(s) + ki*Ts*(1 - y);
    u = kp*(1 - y) + s;
  end when;
  annotation(experiment(StopTime=3, Interval=0.01));
end SampledController;
