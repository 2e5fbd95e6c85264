// code: R013
// line: 5
// hint: inner Real g
model M
  outer parameter Real g;
  Real x;
equation
  x = g;
end M;
