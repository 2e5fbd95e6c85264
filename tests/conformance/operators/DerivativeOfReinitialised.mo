// section: 3.7.4
// value: x6 = 1, x5 = 0.25
model DerivativeOfReinitialised
  Real x4(start = 0, fixed = true), x5, x6;
equation
  when time > 0.5 then
    reinit(x4, 0);
  end when;
  der(x4) = 1;
  x5 = x4^2;
  x6 = der(x5);
end DerivativeOfReinitialised;
