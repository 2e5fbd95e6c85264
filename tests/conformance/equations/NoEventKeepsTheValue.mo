// section: 3.7.5
// value: y = 0.5
model NoEventKeepsTheValue
  Real y = noEvent(if time > 0.5 then time - 0.5 else 0);
end NoEventKeepsTheValue;
