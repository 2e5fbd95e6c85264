within Lacuna.Components.Drives;
model AveragedDrive "Current control with a continuous duty, averaged over the modulation"
  extends Interfaces.PartialDrive;
  parameter Types.Voltage V(final min=0, start=28) "Bus voltage for which the duty is computed";
  parameter Types.Resistance Kp(final min=0, start=5) "Proportional gain of the current loop";
  parameter Real Ki(final min=0, final unit="Ohm/s", start=1000) "Integral gain of the current loop";
  parameter Types.PerUnit onset(final min=1e-9) = 1e-2 "Part of the bus voltage over which holding sets in";
  AveragedBridge bridge "Inverter";
  Types.PerUnit duty "Duty of the driven pair";
  Types.Voltage x(start=0, fixed=true) "Integral part of the voltage command";
protected
  Types.Current error "Current error";
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
  error = i_set - i_pair;
  v_free = Kp*error + x;
  duty = if v_free > V then 1 elseif v_free < -V then -1 else v_free/V;
  // How far the command is beyond the limit towards which the error drives it is no variable: at rest rounding gives
  // the error's sign, which the product makes nothing of.
  der(x) = Ki*error*max(0, min(1, 1 - (noEvent(if error > 0 then v_free else -v_free) - V)/(onset*V)));
  annotation(Documentation(info="<html>
<p>Proportional-integral control of the pair's current; the duty saturates at full voltage, and the integral is held
while it would drive further into saturation. The duty is computed for the nominal bus voltage, as a drive without a
measurement of its bus does; the loop makes up for a sag. The fast variant: its only events are commutations and
limits.</p>
</html>"));
end AveragedDrive;
