// section: 10.3.4
// refuse: R051 12
model SumOfVectorsOfAVaryingRange
  record R
    Real v[2];
  end R;
  function f
    input R r[2];
    input Integer n;
    output Real y;
  algorithm
    y := sum(r[1:n].v);
  end f;
  Integer n = 1 + integer(time);
  Real y = f({R({time, 1}), R({2, 3})}, n);
end SumOfVectorsOfAVaryingRange;
