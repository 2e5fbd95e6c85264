// section: 8.6
// value: t0 = 0, y = 2
model StartTime
  parameter Real t0(fixed=false);
  Real y = 2*(time - t0);
initial equation
  t0 = time;
end StartTime;
