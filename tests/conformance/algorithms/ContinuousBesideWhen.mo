// section: 11.1
// value: u at 0.8 = 1.6, y at 0.2 = 1, y at 0.8 = 2, w at 0.2 = 1.4, w at 0.8 = 3.6, c = 1
model ContinuousBesideWhen "What no 'when' assigns follows the time between events"
  Real y(start = 1);
  Integer c(start = 0, fixed = true);
  Real u, w;
algorithm
  u := time;
  u := 2*u;
  when u > 1 then
    c := pre(c) + 1;
    y := 2*u;
  elsewhen u > 3 then
    y := 5;
  end when;
  w := u + y;
end ContinuousBesideWhen;
