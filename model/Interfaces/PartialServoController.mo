within Lacuna.Interfaces;
partial block PartialServoController "Position servo: from commanded position to a voltage"
  parameter Types.PerUnit N = 1 "Turns of the motor for one turn of the output";
  parameter Real Kp(final unit="1/s", start=10) "Gain of the position loop";
  parameter Types.AngularVelocity wmax(final min=0, start=500) "Largest reference speed";
  parameter Types.BackEmfConstant Kw(start=0.1) "Proportional gain of the speed loop";
  parameter Real Ki(final unit="V/rad", start=1) "Integral gain of the speed loop";
  parameter Types.Voltage Vdc(final min=0, start=28) "Largest voltage";
  RealInput command(unit="rad") "Commanded position";
  RealInput position(unit="rad") "Measured position";
  RealInput speed(unit="rad/s") "Measured speed of the motor";
  RealOutput u(unit="V") "Voltage command";
end PartialServoController;
