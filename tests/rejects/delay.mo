// code: R091
// line: 7
// hint: first-order lags
model M
  Real x;
equation
  x = delay(time, 1);
end M;
