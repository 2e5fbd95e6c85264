within Lacuna.Components.Control;
block Adc "Analog-to-digital conversion: sampling, range and resolution"
  extends Interfaces.SISO(y(start=0, fixed=true));
  parameter Types.Time T(final min=1e-6, start=1e-3) "Sampling period";
  parameter Real range(final min=1e-12, start=10) "Largest magnitude that can be converted";
  parameter Integer bits(final min=1, final max=32) = 12 "Bits, sign included";
protected
  parameter Real lsb = 2*range/2^bits "Value of one step";
equation
  when sample(0, T) then
    y = max(-range, min(range - lsb, lsb*floor(u/lsb + 0.5)));
  end when;
  annotation(Documentation(info="<html>
<p>Law: the nearest multiple of <code>lsb = 2 range/2^bits</code> within the range, at each sample, held between
samples. The
error is uniform within <code>lsb/2</code>, of standard deviation <code>lsb/sqrt(12)</code>, until the range ends.</p>
</html>"));
end Adc;
