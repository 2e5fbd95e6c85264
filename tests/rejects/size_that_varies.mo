// code: F021
// line: 6
// hint: parameters and constants
model M
  Integer n = if time > 1 then 2 else 3;
  Real x[n];
equation
  x = ones(n);
end M;
