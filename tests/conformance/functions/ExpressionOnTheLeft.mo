// section: 12.4.3
// refuse: R058 14
function f
  input Real a;
  output Real x;
  output Real y;
algorithm
  x := a;
  y := 2*a;
end f;
model ExpressionOnTheLeft
  Real x, y;
equation
  (x + 1, y) = f(1.0);
end ExpressionOnTheLeft;
