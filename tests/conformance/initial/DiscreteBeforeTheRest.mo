// section: 8.6
// value: a = 2, n = 1, z = 0.5, w at 0 = 0.5, s = 0.5
model DiscreteBeforeTheRest "what when initial() sets holds with the equations, which its start value does not"
  discrete Real a(start=0, fixed=true);
  Integer n(start=0, fixed=true);
  Real z, w, s(start=0, fixed=true);
equation
  when initial() then
    a = 2;
    n = pre(n) + 1;
  end when;
  z = 1/a;
  w + log(a)*w^3 - log(2)*w^3 = z;
  der(s) = z;
end DiscreteBeforeTheRest;
