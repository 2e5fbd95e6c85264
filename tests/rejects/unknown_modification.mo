// code: R032
// line: 9
// hint: did you mean R
model Motor
  parameter Real Rs = 1;
  Real i = Rs*time;
end Motor;
model M
  Motor motor(Rz = 2);
end M;
