within Lacuna.Actuators.Scenarios;
model Pwm "Step with pulse-width modulation and dead time"
  extends FlightControlEma(redeclare Components.Drives.PwmDrive drive(i_max=15, f_pwm=8e3, Kp=2, Ki=500));
  annotation(experiment(StopTime=0.3, Tolerance=1e-6, Interval=1e-4));
end Pwm;
