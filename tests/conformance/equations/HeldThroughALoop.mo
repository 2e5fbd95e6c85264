// section: 8.5
// value: seen = 2, n = 1
model HeldThroughALoop
  discrete Real n(start = 0, fixed = true), seen(start = 0, fixed = true);
  Real a, b;
equation
  a = 0.5*b + n;
  b = 0.5*a + 1;
  when time > 0.5 then
    n = pre(n) + 1;
    seen = b;
  end when;
end HeldThroughALoop;
