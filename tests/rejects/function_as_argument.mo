// code: R090
// line: 7
// hint: an input that is a function
model M
  Real x;
equation
  x = sin(function cos(u = 1));
end M;
