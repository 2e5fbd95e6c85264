// section: 3.7.4.2
// value: b = -0.9824526126
model TransportFasterThanSteps
  Real x(start = 0, fixed = true), b;
equation
  der(x) = 50;
  (, b) = spatialDistribution(sin(5*time), 0, x, true);
end TransportFasterThanSteps;
