within Lacuna.Actuators.Scenarios;
model SlowSine "Slow sine: the hinge sticks and slips at each reversal"
  extends FlightControlEma(redeclare Components.Sources.Sine command(amplitude=0.02, f=0.5));
  annotation(experiment(StopTime=4, Tolerance=1e-6));
end SlowSine;
