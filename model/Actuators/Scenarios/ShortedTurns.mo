within Lacuna.Actuators.Scenarios;
model ShortedTurns "Step with a fifth of the turns of phase a shorted"
  extends FlightControlEma(short_a=0.2);
  annotation(experiment(StopTime=1, Tolerance=1e-6));
end ShortedTurns;
