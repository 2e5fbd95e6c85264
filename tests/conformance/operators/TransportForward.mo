// section: 3.7.4.2
// value: b = 0.9974949866, b at 0.25 = 0, a = 0.1411200081
model TransportForward
  Real x(start = 3, fixed = true), a, b;
equation
  der(x) = 2;
  (a, b) = spatialDistribution(sin(3*time), 7, x, true, {0, 1}, {0, 0});
end TransportForward;
