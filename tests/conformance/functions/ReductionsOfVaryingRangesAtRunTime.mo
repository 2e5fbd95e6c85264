// section: 10.3.4
// value: y = 44
model ReductionsOfVaryingRangesAtRunTime
  function f
    input Real x[:];
    input Integer n;
    output Real y;
  algorithm
    y := sum(x[i]*x[j] for i in 1:n, j in 1:n) + product(x[i] for i in 1:n) + min(x[2:n]);
  end f;
  Integer n = if time > 0.5 then 3 else 3;
  Real y = f({1, 2, 3, 4}, m);
  Integer m(start=3, fixed=true);
equation
  when time > 0.5 then
    m = 3;
  end when;
end ReductionsOfVaryingRangesAtRunTime;
