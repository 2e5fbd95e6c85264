// code: R041
// line: 8
// hint:
model Motor
  Real w = time;
end Motor;
model M
  Motor motor = 3;
end M;
