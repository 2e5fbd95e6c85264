// section: 3.7.4.2
// value: a = 0.9974949866, a at 0.25 = 0, b = 0.1411200081
model TransportBackward
  Real x(start = 0, fixed = true), a, b;
equation
  der(x) = -2;
  (a, b) = spatialDistribution(7, sin(3*time), x, false);
end TransportBackward;
