// section: 8.6
// value: y = 4
model ParameterThatAnotherFollows
  parameter Real p(fixed=false, start=1);
  parameter Real q = 2*p;
  Real y = q;
initial equation
  p^3 = 8;
end ParameterThatAnotherFollows;
