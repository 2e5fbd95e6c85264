// section: 8.6
// value: q = 6, y = 6
model ParameterFromParameters
  parameter Real p = 3;
  parameter Real q(fixed=false);
  Real y = q*time;
initial equation
  q = 2*p;
end ParameterFromParameters;
