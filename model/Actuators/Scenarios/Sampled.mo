within Lacuna.Actuators.Scenarios;
model Sampled "Step with a digital controller, converters and noisy lines"
  extends FlightControlEma(
    redeclare Components.Control.SampledController controller(
      T=1e-3, position_range=0.5, speed_range=800, position_noise=2e-5, speed_noise=0.5));
  annotation(experiment(StopTime=1, Tolerance=1e-6));
end Sampled;
