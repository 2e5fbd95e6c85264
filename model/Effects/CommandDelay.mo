within Lacuna.Effects;
model CommandDelay "Servo controller that learns of its command after a fixed time"
  extends Lacuna.Interfaces.PartialServoController;
  parameter Types.Time T_d(final min=0) = 1e-3 "Delay";
  parameter Types.Time interval(final min=0) = 1e-3 "Time between the samples of the command";
  Types.AngularVelocity wref = servo.wref "Reference speed";
  Types.Angle xi = servo.xi "Integral of the speed error";
  Interfaces.SampledDelay bus(u(unit="rad"), T_d=T_d, interval=interval) "Bus that brings the command";
  Components.Control.ServoController servo(N=N, Kp=Kp, wmax=wmax, Kw=Kw, Ki=Ki, Vdc=Vdc) "Position and speed loops";
equation
  bus.u = command;
  servo.command = bus.late;
  servo.position = position;
  servo.speed = speed;
  u = servo.u;
  annotation(__Lacuna(effect="drive.delay", attaches="replace", replaces="ServoController",
    starts(T_d={0.5, 1, 2, 6, 15, 30}), relative(T_d="interval"), interval="interval",
    signature="the loop follows as believed, but later than its command", excitation="steps or fast changes of the command",
    reference="Franklin, Powell, Workman 1998"));
end CommandDelay;
