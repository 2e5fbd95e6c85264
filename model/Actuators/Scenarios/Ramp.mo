within Lacuna.Actuators.Scenarios;
model Ramp "Ramp of the command"
  extends FlightControlEma(redeclare Components.Sources.Ramp command(height=0.15, duration=0.5, t_start=0.05));
  annotation(experiment(StopTime=1, Tolerance=1e-6));
end Ramp;
