// section: 3.7.4.2
// value: b[1] = 0.5, b[2] = 1, b[2] at 0.2 = 1
model TransportOfArrays
  Real x(start = 0, fixed = true), a[2], b[2];
equation
  der(x) = 2;
  (a, b) = spatialDistribution({time, 2*time}, {0, 0}, x, true, {0, 1}, {{0, 0}, {1, 1}});
end TransportOfArrays;
