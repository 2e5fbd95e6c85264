within Lacuna.Components.Drives;
model AveragedDrive "Current control with a continuous duty, averaged over the modulation"
  extends Interfaces.PartialDrive;
  parameter Types.Voltage V(final min=0, start=28) "Bus voltage for which the duty is computed";
  parameter Types.Resistance Kp(final min=0, start=5) "Proportional gain of the current loop";
  parameter Real Ki(final min=0, final unit="Ohm/s", start=1000) "Integral gain of the current loop";
  AveragedBridge bridge "Inverter";
  Types.PerUnit duty "Duty of the driven pair";
  Types.Voltage x(start=0, fixed=true) "Integral part of the voltage command";
protected
  Types.Voltage v_free "Voltage command before the limit";
equation
  commutation.dir = 1;
  connect(commutation.leg, bridge.leg);
  connect(p, bridge.p);
  connect(n, bridge.n);
  connect(bridge.a, a);
  connect(bridge.b, b);
  connect(bridge.c, c);
  bridge.duty = duty;
  v_free = Kp*(i_set - i_pair) + x;
  duty = if v_free > V then 1 elseif v_free < -V then -1 else v_free/V;
  der(x) = if v_free > V and i_set > i_pair or v_free < -V and i_set < i_pair then 0 else Ki*(i_set - i_pair);
  annotation(Documentation(info="<html>
<p>Proportional-integral control of the pair's current; the duty saturates at full voltage, and the integral is held
while it would drive further into saturation. The duty is computed for the nominal bus voltage, as a drive without a
measurement of its bus does; the loop makes up for a sag. The fast variant: its only events are commutations and
limits.</p>
</html>"));
end AveragedDrive;
