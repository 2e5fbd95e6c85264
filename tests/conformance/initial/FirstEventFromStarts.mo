// section: 8.6
// value: n = 1, m = 1, p = 0
model FirstEventFromStarts "the first event iteration goes from the start values of what is discrete"
  Boolean a(start=false, fixed=true), b(start=false, fixed=true);
  Integer k(start=1, fixed=true);
  Integer n(start=0, fixed=true), m(start=0, fixed=true), p(start=0, fixed=true);
equation
  a = true;
  b = pre(a);
  when b then
    n = pre(n) + 1;
  end when;
  k = 5;
  when pre(k) > 3 then
    m = pre(m) + 1;
  end when;
  when a then
    p = pre(p) + 1;
  end when;
end FirstEventFromStarts;
