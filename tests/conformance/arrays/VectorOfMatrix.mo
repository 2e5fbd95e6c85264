// section: 10.3.3
// value: v[3] = 3
model VectorOfMatrix
  Real v[3] = vector([1, 2, 3]);
end VectorOfMatrix;
