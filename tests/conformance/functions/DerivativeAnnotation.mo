// section: 12.7.1
// value: y = 1, dy = 2
model DerivativeAnnotation
  function f
    input Real u;
    output Real y;
  algorithm
    y := u^2;
    annotation(derivative=df);
  end f;
  function df
    input Real u;
    input Real du;
    output Real dy;
  algorithm
    dy := 2*u*du;
  end df;
  Real y = f(time);
  Real dy = der(y);
end DerivativeAnnotation;
