// section: 3.7.3
// value: y at 0.1 = 0, y at 0.45 = 1, z = 4, n = 1
model SmoothAndSampled "smooth, edge, change, sample together in an algorithm"
  Boolean b = time > 0.3;
  Integer n(start = 0, fixed = true);
  Integer z(start = 0, fixed = true);
  Real y;
algorithm
  when edge(b) then
    n := pre(n) + 1;
  end when;
algorithm
  when {change(b), sample(0.1, 0.4)} then
    z := pre(z) + 1;
  end when;
equation
  y = smooth(0, if b then 1 else 0);
end SmoothAndSampled;
