// section: 7.2
// refuse: R032 11
model NoElementOfALocal
  record R
    Real a = 1;
  end R;
  function f
    input Real k;
    output Real y;
  protected
    R r(b=2);
  algorithm
    y := r.a + k;
  end f;
  Real z = f(time);
end NoElementOfALocal;
