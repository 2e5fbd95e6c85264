within Lacuna.Components.Drives;
model PwmDrive "Current regulation by pulse-width modulation, sampled once a period"
  extends Interfaces.PartialSwitchedDrive;
  parameter Types.Frequency f_pwm(final min=1) = 10e3 "Switching frequency";
  parameter Types.Resistance Kp(final min=0, start=5) "Proportional gain of the current loop";
  parameter Real Ki(final min=0, final unit="Ohm/s", start=1000) "Integral gain of the current loop";
  parameter Types.PerUnit duty_max(final min=0, final max=0.99) = 0.95 "Largest duty, either sign";
  Types.PerUnit duty(start=0, fixed=true) "Duty of the present period";
protected
  parameter Types.Time T = 1/f_pwm "Period";
  Types.Voltage x(start=0, fixed=true) "Integral part of the voltage command";
  Types.PerUnit duty_free(start=0) "Duty before the limit";
  Boolean high(start=false, fixed=true) "First part of the period: the pair is driven positive";
  Types.Time t_low(start=0, fixed=true) "End of the first part";
equation
  when sample(0, T) then
    duty_free = (Kp*(i_set - i_pair) + pre(x))/max(p.v - n.v, 1);
    duty = max(-duty_max, min(duty_max, duty_free));
    x = if abs(duty_free) > duty_max and duty_free*(i_set - i_pair) > 0 then pre(x) else pre(x) + Ki*T*(i_set - i_pair);
    high = true;
    t_low = time + T*(1 + duty)/2;
  elsewhen time >= pre(t_low) then
    duty_free = pre(duty_free);
    duty = pre(duty);
    x = pre(x);
    high = false;
    t_low = pre(t_low);
  end when;
  commutation.dir = if high then 1 else -1;
  annotation(Documentation(info="<html>
<p>At the start of each period a sampled proportional-integral law gives the duty; the pair sees the positive bus
voltage
for <code>(1 + duty)/2</code> of the period and the negative for the rest. The integral is held while the duty is at its
limit. The ripple of the current at rest is <code>V T (1 - duty^2)/(4 L)</code> peak to peak for the pair.</p>
</html>"));
end PwmDrive;
