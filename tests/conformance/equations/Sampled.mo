// section: 3.7.5
// value: n = 5, n at 0.15 = 1, n at 0.35 = 2
model Sampled "at 0.1, 0.3, 0.5, 0.7, 0.9"
  Integer n(start=0, fixed=true);
equation
  when sample(0.1, 0.2) then
    n = pre(n) + 1;
  end when;
end Sampled;
