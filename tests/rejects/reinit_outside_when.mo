// code: R056
// line: 8
// hint: when
model M
  Real x(start = 1);
equation
  der(x) = -1;
  reinit(x, 1);
end M;
