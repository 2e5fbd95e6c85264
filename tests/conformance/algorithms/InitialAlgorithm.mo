// section: 8.6
// value: x = 4
model InitialAlgorithm
  Real x;
initial algorithm
  x := 3;
equation
  der(x) = 1;
end InitialAlgorithm;
