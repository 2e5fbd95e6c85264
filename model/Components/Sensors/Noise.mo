within Lacuna.Components.Sensors;
block Noise "Normal noise at a fixed rate, from a seed"
  extends Interfaces.Source(y(start=0, fixed=true));
  parameter Types.Time T(final min=1e-7, start=1e-3) "Time between two values";
  parameter Real std(final min=0, start=1) "Standard deviation";
  parameter Integer seed = 1 "Seed; another one gives another sequence";
protected
  constant Real pi = 3.141592653589793;
  Integer s1(start=1 + mod(171*mod(seed, 30269) + 11, 30268), fixed=true) "First congruence";
  Integer s2(start=1 + mod(172*mod(seed, 30307) + 23, 30306), fixed=true) "Second congruence";
  Integer s3(start=1 + mod(170*mod(seed, 30323) + 37, 30322), fixed=true) "Third congruence";
  Integer r1(start=1, fixed=true) "First congruence, half a step on";
  Integer r2(start=1, fixed=true) "Second congruence, half a step on";
  Integer r3(start=1, fixed=true) "Third congruence, half a step on";
  Real u1(start=0, fixed=true) "First uniform number, in [0, 1)";
  Real u2(start=0, fixed=true) "Second uniform number, in [0, 1)";
equation
  when sample(0, T) then
    r1 = mod(171*pre(s1), 30269);
    r2 = mod(172*pre(s2), 30307);
    r3 = mod(170*pre(s3), 30323);
    s1 = mod(171*r1, 30269);
    s2 = mod(172*r2, 30307);
    s3 = mod(170*r3, 30323);
    u1 = mod(r1/30269 + r2/30307 + r3/30323, 1);
    u2 = mod(s1/30269 + s2/30307 + s3/30323, 1);
    y = std*sqrt(-2*log(1 - u1))*cos(2*pi*u2);
  end when;
  annotation(Documentation(info="<html>
<p>A new value every <code>T</code>, held between, so the sequence does not depend on the steps of a solver. Uniform
numbers
by Wichmann and Hill (period 7e12), made normal by Box and Muller.</p>
<p>References: B. A. Wichmann, I. D. Hill: Algorithm AS 183, Applied Statistics 31 (1982) 188-190. G. E. P. Box, M. E.
Muller:
Annals of Mathematical Statistics 29 (1958) 610-611.</p>
</html>"));
end Noise;
