// section: 7.2.6
// refuse: R031 12
model FinalElementOfALocal
  record R
    final parameter Real a = 1;
    Real c = 2;
  end R;
  function f
    input Real k;
    output Real y;
  protected
    R r(a=2);
  algorithm
    y := r.a + k;
  end f;
  Real z = f(time);
end FinalElementOfALocal;
