within Lacuna.Actuators.Scenarios;
model Pwm "Step with pulse-width modulation and dead time"
  extends FlightControlEma(
    command(t_start=0.01),
    redeclare Components.Drives.PwmDrive drive(f_pwm=8e3, Kp=Kp_i, Ki=Ki_i));
  annotation(experiment(StopTime=0.1, Tolerance=1e-8));
end Pwm;
