// section: 12.7.1
// refuse: R050 9
model DerivativeOfOrderZero "an order of zero"
  function f
    input Real x;
    output Real y;
  algorithm
    y := x^2;
    annotation(derivative(order=0)=df);
  end f;
  function df
    input Real x;
    input Real dx;
    output Real dy = 2*x*dx;
  algorithm
  end df;
  Real y = f(time);
  Real z = der(y);
end DerivativeOfOrderZero;
