// section: 3.7.4.1
// value: x = 0.2605794270833333, y = 0.3723958333333333, z = 0.75, p = 0.75, s at 0.7 = 0, s at 0.8 = 1
model Delay
  parameter Real T = 0.25;
  Real x(start = 1, fixed = true);
  Real y = delay(x, T);
  Real z = delay(time, T, 2*T);
  Real p = delay(3*T, T);
  Real s = delay(if time > 0.5 then 1 else 0, T);
equation
  der(x) = -y;
end Delay;
