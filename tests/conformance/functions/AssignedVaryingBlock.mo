// section: 10.5.1
// value: A[1,1] = 1, A[1,2] = 3, A[2,1] = 2, A[2,2] = 4, A[3,3] = 5, B[1,1] = 7, B[1,2] = 10, B[3,3] = 0
model AssignedVaryingBlock "blocks of matrices"
  function f
    input Real M[:, :];
    input Integer n;
    output Real A[3, 3] = 5*ones(3, 3);
    output Real B[3, 3] = zeros(3, 3);
  algorithm
    A[1:n, 1:n] := transpose(M[1:n, 1:n]);
    B[1:n, 1:n] := M[1:n, 1:n]*M[1:n, 1:n];
    A[1:n] := A[1:n, :];
  end f;
  Integer n(start=2, fixed=true);
  Real A[3, 3], B[3, 3];
equation
  (A, B) = f({{1, 2, 0}, {3, 4, 0}, {0, 0, 0}}, n);
  when time > 2 then
    n = 1;
  end when;
end AssignedVaryingBlock;
