// section: 8.3.5
// value: u = 0.54, x = 1.068
model SampledControl "What is read at the tick follows what the last tick set, but through a derivative: no circle"
  Real x(start = 0, fixed = true), y;
  discrete Real u(start = 0, fixed = true);
equation
  y = x;
  2*der(x) = 2*u + 0*y;
  when sample(0, 0.4) then
    u = 1.5 - y;
  end when;
end SampledControl;
