// section: 12.4.2
// value: a = 1.25
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
partial function SI
  input Real x;
  input Real y;
  output Real z;
end SI;
function qo
  input Real x;
  input Real y1;
  input Real y2;
  input SI integrand;
  output Real z;
algorithm
  z := quadrature(y1, y2, function integrand(y = x));
end qo;
function sq
  input Real x1;
  input Real x2;
  input Real y1;
  input Real y2;
  input SI integrand;
  output Real integral;
algorithm
  integral := quadrature(x1, x2, function qo(y1 = y1, y2 = y2, integrand = integrand));
end sq;
function prod2
  extends SI;
algorithm
  z := x*y + 1;
end prod2;
model FunctionalArgumentsInside
  Real a = sq(0, 1, 0, 1, prod2);
end FunctionalArgumentsInside;
