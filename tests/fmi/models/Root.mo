model Root "Starts at the root of an initial equation, and is drawn to a parameter"
  parameter Real a = 2, b = 3*a;
  Real x(start = 1), y(start = 2, fixed = true);
  output Real z = b*x;
initial equation
  x^2 = a*y;
equation
  der(x) = a - x;
  der(y) = -y;
end Root;
