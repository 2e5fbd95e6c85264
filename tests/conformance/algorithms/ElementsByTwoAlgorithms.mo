// section: 11.1.2
// refuse: S003 8
model ElementsByTwoAlgorithms
  Real x[2](start = {-11, -22});
algorithm
  x[1] := 1;
algorithm
  x[2] := 2;
end ElementsByTwoAlgorithms;
