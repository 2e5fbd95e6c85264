// section: 8.6
// value: x at 0 = 5, y at 0 = 10, a at 0 = 1, v at 0 = 3, v at 0.4 = 3, v = 7, p at 0 = 5, q at 0 = 2, r at 0 = 3
model ReinitAtTheStart "reinit where initial() is a condition is an initial equation"
  parameter Boolean c=true;
  Real x, y, v, p, q(start=2), r;
  discrete Real a;
equation
  der(x) = -x;
  y = 2*x;
  when initial() then
    reinit(x, 5);
    a = 1;
    if c then
      reinit(p, x);
    end if;
    if not c then
      reinit(q, 5);
    end if;
    if not c then
      reinit(r, 4);
    else
      reinit(r, 3);
    end if;
  end when;
  der(p) = -p;
  der(q) = -q;
  der(r) = -r;
  der(v) = 0;
  when {initial(), time > 0.5} then
    reinit(v, if time < 0.5 then 3 else 7);
  end when;
end ReinitAtTheStart;
