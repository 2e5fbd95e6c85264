within Lacuna.Actuators.Scenarios;
model Hysteresis "Step with current regulation within a band"
  extends FlightControlEma(redeclare Components.Drives.HysteresisDrive drive(i_max=15, band=1));
  annotation(experiment(StopTime=0.3, Tolerance=1e-6, Interval=1e-4));
end Hysteresis;
