// section: 4.7
// refuse: R015 11
model PartialRecordOfALocal
  partial record R
    Real a = 1;
  end R;
  function f
    input Real k;
    output Real y;
  protected
    R r;
  algorithm
    y := r.a + k;
  end f;
  Real z = f(time);
end PartialRecordOfALocal;
