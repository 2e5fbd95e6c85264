// section: 8.6
// value: x at 0 = 5, y at 0 = 10, a at 0 = 1, v at 0 = 3, v at 0.4 = 3, v = 7
model ReinitAtTheStart "reinit where initial() is a condition is an initial equation"
  Real x, y, v;
  discrete Real a;
equation
  der(x) = -x;
  y = 2*x;
  when initial() then
    reinit(x, 5);
    a = 1;
  end when;
  der(v) = 0;
  when {initial(), time > 0.5} then
    reinit(v, if time < 0.5 then 3 else 7);
  end when;
end ReinitAtTheStart;
