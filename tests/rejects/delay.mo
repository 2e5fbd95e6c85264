// code: R091
// line: 8
// hint: parameter
model M
  Real x;
  Real T = 1 + time;
equation
  x = delay(time, T, 9);
end M;
