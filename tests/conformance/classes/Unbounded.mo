// section: 4.9.6
// value: x = 1, y = 2
model Unbounded
  Real x(start = 0, fixed = true, unbounded = true);
  Real y(unbounded = false) = 2*x;
equation
  der(x) = 1;
end Unbounded;
