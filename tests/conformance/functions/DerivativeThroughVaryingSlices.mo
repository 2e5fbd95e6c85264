// section: 12.7
// value: dy = 6, x = 0.5, dq = 3
model DerivativeThroughVaryingSlices "derivatives of kept functions with slices, and an implicit equation through one"
  function f
    input Real a[:];
    input Integer n;
    output Real y;
  protected
    Real w[size(a, 1)];
  algorithm
    w := zeros(size(a, 1));
    w[1:n] := 2*a[1:n];
    y := w[1:n]*a[1:n];
  end f;
  Integer n(start=2, fixed=true);
  Real y = f({time, 1, time - 0.5}, n), dy = der(y);
  Real x(start=1);
  Real u[3] = {time, time - 0.5, 2*time};
  Integer k(start=1, fixed=true);
  Real q = sum(u[i]^2 for i in 1:k), dq = der(q);
equation
  f({x, 2, 3}, n) = 0.5 + 8 + (n - 2)*18;
  when time > 0.5 then
    n = 3;
    k = 2;
  end when;
end DerivativeThroughVaryingSlices;
