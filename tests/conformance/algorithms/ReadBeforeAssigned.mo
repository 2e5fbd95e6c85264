// section: 11.1.2
// value: x = 2, n = 0, m = 1
model ReadBeforeAssigned "A continuous variable has its start value before the first assignment"
  Real x(start = 0.5);
  Integer n(start = 0, fixed = true), m(start = 0, fixed = true);
algorithm
  when x > 1 then
    n := pre(n) + 1;
  end when;
  x := 2*time;
  when x > 1 then
    m := pre(m) + 1;
  end when;
end ReadBeforeAssigned;
