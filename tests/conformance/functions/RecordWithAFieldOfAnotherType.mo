// section: 6.4
// refuse: R062 19
model RecordWithAFieldOfAnotherType
  record R
    Integer a;
  end R;
  record S
    Real a;
  end S;
  function f
    input R r;
    output Real y;
  algorithm
    y := r.a;
  end f;
  S s(a=1);
  R r(a=2);
  Real z = f(r);
  Real y = f(s);
end RecordWithAFieldOfAnotherType;
