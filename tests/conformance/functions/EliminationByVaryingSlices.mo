// section: 10.5.1
// value: y = 6
model EliminationByVaryingSlices "gaussian elimination with slices"
  function solve
    input Real M[:, :];
    input Real b[:];
    input Integer n;
    output Real x[size(b, 1)];
  protected
    Real A[size(M, 1), size(M, 2)];
    Real c[size(b, 1)];
    Real p;
    Integer i;
  algorithm
    A := M;
    c := b;
    x := zeros(size(b, 1));
    for k in 1:n - 1 loop
      for j in k + 1:n loop
        p := A[j, k]/A[k, k];
        A[j, k:n] := A[j, k:n] - p*A[k, k:n];
        c[j] := c[j] - p*c[k];
      end for;
    end for;
    i := n;
    while i > 0 loop
      x[i] := (c[i] - A[i, i + 1:n]*x[i + 1:n])/A[i, i];
      i := i - 1;
    end while;
  end solve;
  Integer n = if time > 0.5 then 3 else 2;
  Real s[3] = solve({{2, 1, 0}, {1, 3, 1}, {0, 1, 2}}, {4, 10, 8}, n);
  Real y = s[1] + s[2] + s[3];
end EliminationByVaryingSlices;
