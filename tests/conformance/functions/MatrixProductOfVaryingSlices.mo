// section: 10.6.3
// value: y = 10, y at 0.3 = 4
model MatrixProductOfVaryingSlices
  function f
    input Real A[:, :];
    input Real x[:];
    input Integer n;
    output Real y;
  algorithm
    y := sum(A[1:n, 1:n]*x[1:n]);
  end f;
  Integer n(start=1, fixed=true);
  Real y = f({{4, 3, 9}, {2, 1, 9}, {9, 9, 9}}, {1, 1, 9}, n);
  equation
    when time > 0.5 then
      n = 2;
    end when;
end MatrixProductOfVaryingSlices;
