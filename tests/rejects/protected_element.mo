// code: R017
// line: 14
// hint: make it public
model Motor
protected
  Real secret;
equation
  secret = time;
end Motor;
model M
  Motor motor;
  Real x;
equation
  x = motor.secret;
end M;
