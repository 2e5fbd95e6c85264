// section: 8.3.5
// value: n = 1, n at 0.4 = 0
model WhenOnce "a when fires where its condition becomes true, not while it is"
  Integer n(start=0, fixed=true);
equation
  when time > 0.52 then
    n = pre(n) + 1;
  end when;
end WhenOnce;
