within Lacuna.Components.Control;
block SampledController "Position and speed loops of a digital control unit, with converters and noisy inputs"
  extends Interfaces.PartialController(i_ref(start=0, fixed=true));
  parameter Types.Time T(final min=1e-6) = 1e-3 "Sampling period";
  parameter Types.Angle position_range(final min=0, start=1) "Range of the position's converter";
  parameter Types.AngularVelocity speed_range(final min=0, start=1000) "Range of the speed's converter";
  parameter Integer bits(final min=1, final max=32) = 12 "Bits of the converters";
  parameter Types.Angle position_noise(final min=0) = 0 "Standard deviation of the noise on the position";
  parameter Types.AngularVelocity speed_noise(final min=0) = 0 "Standard deviation of the noise on the speed";
  parameter Integer seed = 1 "Seed of the noise";
  Adc positionAdc(T=T, range=position_range, bits=bits) "Converter of the position";
  Adc speedAdc(T=T, range=speed_range, bits=bits) "Converter of the speed";
  Sensors.Noise positionNoise(T=T, std=position_noise, seed=seed) "Noise on the line of the position";
  Sensors.Noise speedNoise(T=T, std=speed_noise, seed=seed + 1) "Noise on the line of the speed";
  Types.AngularVelocity w_ref(start=0, fixed=true) "Reference speed";
protected
  Types.Current x(start=0, fixed=true) "Integral part of the reference current";
  Types.Current i_free(start=0, fixed=true) "Reference current before its limit";
  Types.AngularVelocity error(start=0, fixed=true) "Speed error";
equation
  positionAdc.u = position + positionNoise.y;
  speedAdc.u = speed + speedNoise.y;
  when sample(0, T) then
    w_ref = max(-w_max, min(w_max, Kp*N*(command - positionAdc.y)));
    error = w_ref - speedAdc.y;
    i_free = Kw*error + pre(x);
    i_ref = max(-i_max, min(i_max, i_free));
    x = if abs(i_free) > i_max and i_free*error > 0 then pre(x) else pre(x) + T*Ki*error;
  end when;
  annotation(Documentation(info="<html>
<p>The law of <code>PositionController</code> evaluated at each sample on converted inputs; the reference is held
between
samples.</p>
</html>"));
end SampledController;
