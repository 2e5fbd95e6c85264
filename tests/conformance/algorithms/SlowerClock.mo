// section: 8.5
// value: n = 2
model SlowerClock
  Boolean fastSample, slowSample(start = false, fixed = true);
  Integer ticks(start = 0, fixed = true);
  Integer n(start = 0, fixed = true);
equation
  fastSample = sample(0, 0.1);
algorithm
  when fastSample then
    ticks := if pre(ticks) < 5 then pre(ticks) + 1 else 0;
    slowSample := pre(ticks) == 0;
  end when;
algorithm
  when slowSample then
    n := pre(n) + 1;
  end when;
end SlowerClock;
