// section: 3.7.4.2
// refuse: R054 7
function f
  input Real x;
  output Real y;
algorithm
  y := spatialDistribution(1, 1, x, true);
end f;
model TransportInAFunction
  Real b = f(time);
end TransportInAFunction;
