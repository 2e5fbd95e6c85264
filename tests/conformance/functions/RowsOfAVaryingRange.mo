// section: 10.3.4.1
// refuse: F036 11
model RowsOfAVaryingRange "how many scalars a sum is of varies, and it is no sum of rows"
  function f
    input Real A[:, :];
    input Integer n;
    output Real y[2] = sum(A[1:n]);
  algorithm
  end f;
  Integer n = 1 + integer(time);
  Real y[2] = f([1, 2; 3, 4], n);
end RowsOfAVaryingRange;
