// section: 3.7.4.2
// value: T at 0.3 = 0.7, T at 0.5 = 0.5138888889
model TransportInALoop
  Real x(start = 0, fixed = true), T(start = 1, fixed = true), b;
equation
  der(x) = 3;
  (, b) = spatialDistribution(T, 0, x, true, {0, 1}, {1, 1});
  der(T) = -b;
end TransportInALoop;
