// section: 4.9
// refuse: R035 8
model NoAttributeOfALocal
  function f
    input Real x;
    output Real y;
  protected
    Real q(foo=3) = 1;
  algorithm
    y := q*x;
  end f;
  Real z = f(time);
end NoAttributeOfALocal;
