within Lacuna.Actuators.Scenarios;
model Eccentric "Step with an eccentric rotor"
  extends FlightControlEma(zeta=0.3);
  annotation(experiment(StopTime=1, Tolerance=1e-6));
end Eccentric;
