// section: 3.7.2
// value: a = -3, b = -1, c = 1, d = 0.25
model DivModRemVarying "of quantities that vary, with events where they jump"
  Real s = -7*time;
  Real a = div(s, 2), b = rem(s, 2), c = mod(s, 2), d = mod(5.25*time, 1);
end DivModRemVarying;
