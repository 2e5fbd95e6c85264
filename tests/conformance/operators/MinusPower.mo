// section: 3.2
// value: a = -4, b = 4, c = -8
model MinusPower "a sign binds less than a power"
  Real a = -2^2 + 0*time, b = (-2)^2, c = -2*2^2;
end MinusPower;
