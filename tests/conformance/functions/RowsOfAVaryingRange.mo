// section: 10.3.4.1
// refuse: R062 7
model RowsOfAVaryingRange "a sum over whole rows is a scalar"
  function f
    input Real A[:, :];
    input Integer n;
    output Real y[2] = sum(A[1:n]);
  algorithm
  end f;
  Integer n = 1 + integer(time);
  Real y[2] = f([1, 2; 3, 4], n);
end RowsOfAVaryingRange;
