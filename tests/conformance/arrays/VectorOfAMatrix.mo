// section: 10.3.2
// refuse: R051 4
model VectorOfAMatrix
  Real v[4] = vector([1, 2; 3, 4]);
end VectorOfAMatrix;
