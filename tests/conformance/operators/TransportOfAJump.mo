// section: 3.7.4.2
// value: b at 0.75 = 0, b at 0.85 = 1, c = 0.2
model TransportOfAJump
  Real x(start = 0, fixed = true), b, c;
equation
  der(x) = 2;
  (, b) = spatialDistribution(if time > 0.3 then 1 else 0, 0, x, true);
  der(c) = b;
initial equation
  c = 0;
end TransportOfAJump;
