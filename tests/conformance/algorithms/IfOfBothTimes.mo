// section: 11.1
// value: u at 0.6 = 0, k at 0.6 = 0, u = 1, k = 2, n = 1
model IfOfBothTimes "one statement that assigns at all times and at events"
  Real u;
  Integer n(start = 0, fixed = true), k(start = 0, fixed = true);
algorithm
  when time > 0.5 then
    n := pre(n) + 1;
  end when;
  if time > 0.7 then
    u := 1;
    k := 2;
  else
    u := 0;
    k := 0;
  end if;
end IfOfBothTimes;
