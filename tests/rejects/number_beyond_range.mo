// code: P030
// line: 6
// hint: at most
model number_beyond_range
  Real x(start=1, fixed=true);
  parameter Real a = 1e999;
equation
  der(x) = -a*x;
end number_beyond_range;
