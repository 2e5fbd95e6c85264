// section: 10.6
// value: y = 30, z = -3, w = 1, v = 8, q = 4
model OperationsOnVaryingSlices
  function f
    input Real x[:];
    input Integer n;
    output Real y;
    output Real z;
    output Real w;
    output Real v;
    output Real q;
  algorithm
    y := x[1:n]*x[2:n + 1] + 10*x[1];
    z := min(-x[1:n]);
    w := max(abs(x[n:-1:1] .+ 2*x[1]) - {2, 2, 2}.*x[1:n] - {2,2,2});
    v := x[1:n]*x[1:n] - sum(sqrt(x[1:n]).^2);
    q := sum(x[n:end] ./ x[n]);
  end f;
  Integer n(start=3, fixed=true);
  Real y, z, w, v, q;
  equation
    (y, z, w, v, q) = f({1, 2, 3, 4, 5}, n);
    when time > 0.5 then
      n = 3;
    end when;
end OperationsOnVaryingSlices;
