// section: 12.7.1
// value: z = 2
model DerivativeAnnotated
  function f
    input Real x; output Real y;
  algorithm
    y := x^2;
    annotation(derivative=df);
  end f;
  function df
    input Real x; input Real dx; output Real dy;
  algorithm
    dy := 2*x*dx;
  end df;
  Real y = f(time);
  Real z = der(y);
end DerivativeAnnotated;
