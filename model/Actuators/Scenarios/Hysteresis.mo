within Lacuna.Actuators.Scenarios;
model Hysteresis "Step with current regulation within a band"
  extends FlightControlEma(
    command(t_start=0.01),
    redeclare Components.Drives.HysteresisDrive drive(band=2));
  annotation(experiment(StopTime=0.1, Tolerance=1e-8));
end Hysteresis;
