// code: R064
// line: 5
// hint: numbers from 0
model M
  Real x = sqrt(-4.0);
end M;
