// section: 12.7.1
// value: y = 5, k = 4, w[3] = 2, dy = 105, dw[1] = 9, dw[2] = 8, dw[3] = 11
model DerivativeOfRecords "Derivatives of the Reals, in order, of inputs and results"
  record R
    Real a;
    Real b[2];
    Integer n;
  end R;
  record Rates
    Real a;
    Real b[2];
  end Rates;
  function f
    input R r;
    input Integer m;
    input Real v[:];
    output Real y;
    output Integer k;
    output Real w[size(v, 1)];
  algorithm
    y := r.a*r.n + r.b[1]*r.b[2];
    k := m;
    w := v*r.a;
    annotation(derivative=df);
  end f;
  function df
    input R r;
    input Integer m;
    input Real v[:];
    input Rates dr;
    input Real dv[size(v, 1)];
    output Real dy;
    output Real dw[size(v, 1)];
  algorithm
    dy := 100 + dr.a*r.n + r.b[1]*dr.b[2] + dr.b[1]*r.b[2];
    dw := dv*r.a + v*dr.a + fill(7, size(v, 1));
  end df;
  R r(a=time, b={time, 2}, n=3);
  Real y, w[3];
  Integer k;
  Real dy = der(y), dw[3] = der(w);
equation
  (y, k, w) = f(r, 4, {time, 1, 2*time});
end DerivativeOfRecords;
