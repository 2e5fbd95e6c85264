// section: 11.1
// value: x at 0.2 = 1, x = 14, n = 9, m = 1
model IfOfBothTimesReadsItself
  Real x;
  Integer n;
  Integer m(start = 0, fixed = true);
algorithm
  if time > 0.5 then
    x := 4;
    n := if x > 3 then 9 else 0;
    x := x + 10;
  else
    x := 1;
    n := 3;
  end if;
  when n > 5 then
    m := pre(m) + 1;
  end when;
end IfOfBothTimesReadsItself;
