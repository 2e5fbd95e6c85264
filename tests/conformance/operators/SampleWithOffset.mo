// section: 3.7.5
// value: n = 4, t at 0.6 = 0.55
model SampleWithOffset "the first tick is at the start that is given"
  Integer n(start=0, fixed=true);
  discrete Real t(start=0, fixed=true);
equation
  when sample(0.05, 0.25) then
    n = pre(n) + 1;
    t = time;
  end when;
end SampleWithOffset;
