// code: F022
// line: 5
// hint: break the circle
model M
  parameter Integer a = b;
  parameter Integer b = a;
  Real x[a];
equation
  x = ones(a);
end M;
