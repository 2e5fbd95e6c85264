// section: 3.7.4.2
// refuse: R064 6
model TransportPointsDescend
  Real x = time, b;
equation
  (, b) = spatialDistribution(0, 0, x, true, {0, 0.7, 0.5, 1}, {1, 2, 4, 4});
end TransportPointsDescend;
