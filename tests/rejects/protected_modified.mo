// code: R037
// line: 10
// hint: extends clause
model Motor
protected
  parameter Real k = 1;
  Real w = k*time;
end Motor;
model M
  Motor motor(k = 2);
end M;
