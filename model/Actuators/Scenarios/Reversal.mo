within Lacuna.Actuators.Scenarios;
model Reversal "Reversals through the play of a worn transmission"
  extends FlightControlEma(
    backlash=5e-3,
    redeclare Components.Sources.Trapezoid command(
      amplitude=0.08, offset=-0.04, rising=0.05, width=0.2, falling=0.05, period=0.5));
  annotation(experiment(StopTime=1, Tolerance=1e-6));
end Reversal;
