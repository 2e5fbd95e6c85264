// section: 11.1
// value: x at 0.2 = 1, x at 0.6 = 20, x = 31, n = 4, m = 1, z = 31
model IfOfBothTimesNested
  Real x;
  Real z;
  Integer n;
  Integer m(start = 0, fixed = true);
algorithm
  z := 0;
  if time > 0.5 then
    x := 20;
    if time > 0.8 then
      n := 4;
      x := x + 11;
      assert(x > 30, "no");
    else
      n := 3;
    end if;
  else
    x := 1;
    n := 1;
  end if;
  when n > 3 then
    m := pre(m) + 1;
  end when;
  z := x;
end IfOfBothTimesNested;
