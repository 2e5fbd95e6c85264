// section: 10.3.4
// value: y = 10, z = 6, x = 10
model SumOfRowsOfAVaryingRange
  function f
    input Real A[:, :];
    input Integer n;
    output Real y = sum(A[1:n]);
    output Real z = sum(A[1:n, 2]);
  algorithm
  end f;
  Integer n = 1 + integer(1.5*time);
  Real A[2,2] = [1, 2; 3, 4];
  Real y,z;
  Real x = sum(A[1:n]);
equation
  (y,z) = f(A, n);
end SumOfRowsOfAVaryingRange;
