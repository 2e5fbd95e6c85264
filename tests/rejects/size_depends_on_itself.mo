// code: R012
// line: 5
// hint: cannot depend
model M
  Real x[n];
  parameter Integer n = size(y, 1);
  Real y[size(x, 1)];
equation
  x = ones(n)*time;
end M;
