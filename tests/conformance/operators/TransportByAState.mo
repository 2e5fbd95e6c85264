// section: 3.7.4.2
// value: b at 0.2 = 4, b at 0.5 = 1.5, b = 0
model TransportByAState
  Real x(start = 0, fixed = true), v(start = 0, fixed = true), b, c(start = 0, fixed = true);
equation
  der(x) = v;
  der(v) = 6;
  (, b) = spatialDistribution(0, 0, x, v >= 0, {0, 0.5, 0.5, 1}, {1, 2, 4, 4});
  der(c) = b;
end TransportByAState;
