// section: 19.1
// value: v = 6, w = 2, a = 4
model UnitsOfKnownResults "products and quotients and powers of known results"
  function f
    input Real x;
    output Real y(unit="m");
  algorithm
    y := x;
  end f;
  Real v(unit="m2") = f(2)*f(3);
  Real w(unit="1") = f(4)/f(2);
  Real a(unit="m2") = f(2)^2;
  Real b(unit="m") = -f(2) + f(5) + 1;
  parameter Integer n = 3;
  Real c(unit="m") = f(n);
end UnitsOfKnownResults;
