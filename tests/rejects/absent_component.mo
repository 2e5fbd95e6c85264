// code: R016
// line: 14
// hint: can only be connected
model Heater
  Real p;
equation
  p = time;
end Heater;
model M
  parameter Boolean heated = false;
  Heater heater if heated;
  Real x;
equation
  x = heater.p;
end M;
