// section: 8.6
// value: p = 4, x at 0.0 = 5
model InitialAlgorithmOrder "the last assignment holds"
  parameter Real p(fixed=false);
  Real x;
initial algorithm
  p := 1;
  p := p + 3;
  x := p + 1;
equation
  der(x) = 0;
end InitialAlgorithmOrder;
