// code: R035
// line: 5
// hint: did you mean start
model M
  Real x(strat = 1);
equation
  der(x) = -x;
end M;
