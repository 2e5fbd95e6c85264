// code: P030
// line: 6
// hint: write a Real
model integer_beyond_range
  Real x(start=1, fixed=true);
  parameter Integer n = 99999999999999999999;
equation
  der(x) = -n*x;
end integer_beyond_range;
