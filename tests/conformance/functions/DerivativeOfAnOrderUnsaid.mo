// section: 12.7.1
// value: y = 1, dy = 3, ddy = 12
model DerivativeOfAnOrderUnsaid "The inputs of the second derivative say that it is one"
  function f
    input Real x;
    input Boolean b;
    output Real y;
  algorithm
    y := x^2;
    annotation(derivative=df);
  end f;
  function df
    input Real x;
    input Boolean b;
    input Real dx;
    output Real dy;
  algorithm
    dy := 3*x*dx;
    annotation(derivative=ddf);
  end df;
  function ddf
    input Real x;
    input Boolean b;
    input Real dx;
    input Real ddx;
    output Real ddy;
  algorithm
    ddy := 12*dx + ddx;
  end ddf;
  Real y = f(time, true);
  Real dy = der(y);
  Real ddy = der(dy);
end DerivativeOfAnOrderUnsaid;
