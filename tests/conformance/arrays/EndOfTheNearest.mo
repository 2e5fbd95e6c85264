// section: 10.5.2
// value: y = 6
model EndOfTheNearest
  parameter Integer i[2] = {1, 3};
  Real A[3] = {2, 4, 6};
  Real y = A[i[end]];
end EndOfTheNearest;
