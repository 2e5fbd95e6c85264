// code: R051
// line: 7
// hint: docs/language.md
model M
  Real x[3];
equation
  x = transpose({1, 2, 3});
end M;
