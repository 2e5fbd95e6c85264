// section: 3.7.4
// value: x = 2.718281828459045, a = 2.718281828459045, b = 2.718281828459045, c = 2
model DerivativeOfADerivative
  Real x(start=1, fixed=true);
  Real a = der(der(x));
  Real b = der(der(der(x)));
  Real c = der(der(time^2));
initial equation
  der(x) = 1;
equation
  a = x;
end DerivativeOfADerivative;
