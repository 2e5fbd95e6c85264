// section: 10.3.4.1
// value: y = 4, q = true
model VaryingRangeOfComponents
  model A
    parameter Real p = 1;
    Real x = p*time;
    Boolean b = x > 0;
  end A;
  A a[3](p = {1, 3, 9});
  Integer k = if time > 0.5 then 2 else 1;
  Real y = sum(a[1:k].x);
  Boolean q = min(a[i].b for i in 1:k);
end VaryingRangeOfComponents;
