// section: 12.7.1
// value: y = 1, dy = 3, ddy = 14, z = 3, x = 2, u = 1
model DerivativeAnnotated "What the annotations say holds, though it is not what the function does"
  function f
    input Real x;
    output Real y;
  algorithm
    y := x^2;
    annotation(derivative=df);
  end f;
  function df
    input Real x;
    input Real dx;
    output Real dy;
  algorithm
    dy := 3*x*dx;
    annotation(derivative(order=2)=ddf);
  end df;
  function ddf
    input Real x;
    input Real dx;
    input Real ddx;
    output Real ddy;
  algorithm
    ddy := 10*dx + 2*ddx;
  end ddf;
  Real s = time + 1e-9*time^2;
  Real y = f(s);
  Real dy = der(y);
  Real ddy = der(dy) + 4 "where index reduction differentiates twice";
  Real z = der(f(time));
  Real x(start=1, fixed=true);
  Real u;
equation
  der(x) = 1;
  der(f(x)) = 3*x*u;
end DerivativeAnnotated;
