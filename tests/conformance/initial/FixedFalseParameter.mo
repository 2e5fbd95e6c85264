// section: 8.6
// value: p = 3, x at 0.0 = 3
model FixedFalseParameter "a parameter that follows from a derivative at the start"
  parameter Real p(fixed=false);
  Real x;
initial equation
  x = 3;
  der(x) = -6;
equation
  der(x) = -2*p + 0*x;
end FixedFalseParameter;
