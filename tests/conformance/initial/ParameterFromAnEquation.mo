// section: 8.6
// value: x = 0.5, p = 0.5
model ParameterFromAnEquation
  parameter Real p(fixed=false, start=1);
  Real x(start=0, fixed=true);
initial equation
  der(x) = 0.5;
equation
  der(x) = p;
end ParameterFromAnEquation;
