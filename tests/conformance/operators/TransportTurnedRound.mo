// section: 3.7.4.2
// value: a at 0.4 = 1.1, a at 0.75 = 5.375, b at 0.2 = 5.88, b at 0.5 = 9, a at 0.1 = 1.1
model TransportTurnedRound
  Real x(start = 0, fixed = true), v, a, b;
equation
  der(x) = v;
  v = 1 - 4*time;
  (a, b) = spatialDistribution(1 + time, 9, x, v >= 0, initialPoints = {0, 1}, initialValues = {5, 6});
end TransportTurnedRound;
