// code: R003
// line: 13
// hint: did you mean torque
model Motor
  Real torque;
equation
  torque = time;
end Motor;
model M
  Motor motor;
  Real x;
equation
  x = motor.torqe;
end M;
