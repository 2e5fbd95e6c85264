// section: 12.4.2
// value: a = 0.5, b = 0.375, c = 0.841470985, d = 0.841470985, area = 1.7507684116
partial function Integrand
  input Real u;
  output Real y;
end Integrand;
function quadrature
  input Real x1;
  input Real x2;
  input Integrand integrand;
  output Real integral;
algorithm
  integral := (x2 - x1)*(integrand(x1) + integrand(x2))/2;
end quadrature;
function quadrature2
  input Real x1;
  input Real x2;
  input Integrand integrand;
  output Real integral;
algorithm
  integral := quadrature(x1, (x1 + x2)/2, integrand) + quadrature((x1 + x2)/2, x2, integrand);
end quadrature2;
function Parabola
  extends Integrand;
algorithm
  y := u*u;
end Parabola;
function Sine
  extends Integrand;
  input Real A;
  input Real w;
algorithm
  y := A*sin(w*u);
end Sine;
function Sine2
  input Real A;
  input Real w;
  input Real x;
  output Real y;
algorithm
  y := A*sin(w*x);
end Sine2;
model FunctionalArguments
  Real a = quadrature(0, 1, Parabola);
  Real b = quadrature2(0, 1, Parabola);
  Real c = quadrature(0, 1, function Sine(A = 2, w = time));
  Real d = quadrature(0, 1, integrand = function Sine2(A = 2, w = 1));
  Real area;
  parameter Integer N = 2;
algorithm
  area := 0;
  for i in 1:N loop
    area := area + quadrature(0, 1, function Sine(A = 2, w = i*time));
  end for;
end FunctionalArguments;
