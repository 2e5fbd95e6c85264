within Lacuna.Actuators.Scenarios;
model EndStop "Command beyond the travel: the surface hits its stop"
  extends FlightControlEma(travel=0.1, command(height=0.2));
  annotation(experiment(StopTime=1, Tolerance=1e-6));
end EndStop;
