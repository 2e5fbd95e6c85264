// section: 8.3.5
// value: u at 0.4 = 1, u at 0.6 = 0.5, x = 0.75
model SampledFeedback
  Real x(start = 0, fixed = true);
  discrete Real u(start = 0, fixed = true);
equation
  der(x) = u - 0*x;
  when sample(0, 0.5) then
    u = 1 - x;
  end when;
end SampledFeedback;
