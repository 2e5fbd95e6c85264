// section: 8.5
// value: seen = 1.5, n = 1.5
model HeldThroughASum
  discrete Real n(start = 0, fixed = true), seen(start = 0, fixed = true);
  Real x, y;
equation
  x + y = n + time;
  x - y = 1;
  when time > 0.5 then
    n = pre(n) + 1.5;
  end when;
  when time > 0.5 then
    seen = x;
  end when;
end HeldThroughASum;
