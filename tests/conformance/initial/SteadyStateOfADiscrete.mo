// section: 8.6
// refuse: S024 11
model SteadyStateOfADiscrete
  discrete Real y(start = 5);
  Boolean st = sample(0.5, 0.5);
equation
  when {initial(), st} then
    y = 0.5*pre(y) + 1;
  end when;
initial equation
  y = pre(y);
end SteadyStateOfADiscrete;
