// section: 8.5
// value: v = 8, n = 4
model HeldThroughAnEquation
  Integer n(start = 0, fixed = true);
  Real u = n*2;
  Real v(start = 0, fixed = true);
equation
  when sample(0.25, 0.25) then
    n = pre(n) + 1;
    v = u;
  end when;
end HeldThroughAnEquation;
