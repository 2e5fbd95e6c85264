// section: 6.4
// refuse: R062 19
model RecordThatLacksAField
  record R
    Real a;
    Real b;
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
  Real y =
    f(s);
end RecordThatLacksAField;
