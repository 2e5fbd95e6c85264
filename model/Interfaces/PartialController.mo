within Lacuna.Interfaces;
partial block PartialController "Actuator control electronics: from commanded position to reference current"
  parameter Types.PerUnit N(start=1) "Turns of the motor for one turn of the output";
  parameter Real Kp(final unit="1/s", start=10) "Gain of the position loop";
  parameter Types.AngularVelocity w_max(final min=0, start=500) "Largest reference speed of the motor";
  parameter Real Kw(final unit="A.s/rad", start=0.1) "Proportional gain of the speed loop";
  parameter Real Ki(final unit="A/rad", start=1) "Integral gain of the speed loop";
  parameter Types.Current i_max(final min=0, start=10) "Largest reference current";
  RealInput command(unit="rad") "Commanded position of the output";
  RealInput position(unit="rad") "Measured position of the output";
  RealInput speed(unit="rad/s") "Measured speed of the motor";
  RealOutput i_ref(unit="A") "Reference current";
  annotation(Documentation(info="<html>
<p>Cascade: a proportional position loop gives a reference speed within <code>-+w_max</code>; a proportional-integral
speed
loop gives a reference current within <code>-+i_max</code>, its integral held at the limit.</p>
</html>"));
end PartialController;
