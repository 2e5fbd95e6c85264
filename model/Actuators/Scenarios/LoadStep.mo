within Lacuna.Actuators.Scenarios;
model LoadStep "Step of the hinge moment while the position is held"
  extends FlightControlEma(command(height=0), redeclare Components.Sources.Step gust(height=60, t_start=0.2));
  annotation(experiment(StopTime=1, Tolerance=1e-6));
end LoadStep;
