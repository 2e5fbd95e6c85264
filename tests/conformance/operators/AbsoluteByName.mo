// section: 3.7.2
// value: b at 0 = 0, z = -1, b = 1
model AbsoluteByName "abs(z) is never negative, also where a variable of its own stands under the power"
  parameter Real n = 1.5;
  Real z;
  Real b = abs(z);
equation
  z*(1 + b^n) = -2*time;
end AbsoluteByName;
