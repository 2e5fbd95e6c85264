// code: R031
// line: 9
// hint: remove
model Motor
  final parameter Real k = 1;
  Real w = k*time;
end Motor;
model M
  Motor motor(k = 2);
end M;
