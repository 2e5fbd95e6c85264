within Lacuna.Components.Drives;
model AveragedDrive "Current control with a continuous duty, averaged over the modulation"
  extends Interfaces.PartialDrive;
  parameter Types.Resistance Kp(final min=0, start=5) "Proportional gain of the current loop";
  parameter Real Ki(final min=0, final unit="Ohm/s", start=1000) "Integral gain of the current loop";
  AveragedBridge bridge "Inverter";
  Types.PerUnit duty "Duty of the driven pair";
  Types.Voltage x(start=0, fixed=true) "Integral part of the voltage command";
protected
  Types.Voltage v_dc "Voltage between the rails";
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
  v_dc = p.v - n.v;
  v_free = Kp*(i_set - i_pair) + x;
  duty = if v_free > v_dc then 1 elseif v_free < -v_dc then -1 else v_free/v_dc;
  der(x) = if v_free > v_dc and i_set > i_pair or v_free < -v_dc and i_set < i_pair then 0 else Ki*(i_set - i_pair);
  annotation(Documentation(info="<html>
<p>Proportional-integral control of the pair's current; the voltage saturates at that of the bus, and the integral is held
while it would drive further into saturation. The fast variant: its only events are commutations and limits.</p>
</html>"));
end AveragedDrive;
