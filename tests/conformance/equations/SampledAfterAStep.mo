// section: 8.5
// value: u at 0.5 = 1, y at 0.5 = 1, w at 0.5 = 3, k at 0.5 = 1
model SampledAfterAStep "What is sampled when a pulse begins is the pulse: all equations of an instant hold together"
  Integer n(start = 0, fixed = true);
  discrete Real begun(start = -10, fixed = true);
  Real u = if time < begun + 5 then 1 else 0;
  discrete Real y(start = 0, fixed = true), k(start = 0, fixed = true);
  Real w(start = 0, fixed = true);
equation
  der(w) = 0;
  when time >= (pre(n) + 1)*0.5 and time < 0.75 then
    n = pre(n) + 1;
    begun = time;
  end when;
  when sample(0, 0.05) then
    y = u;
    k = n;
    reinit(w, 3*u);
  end when;
end SampledAfterAStep;
