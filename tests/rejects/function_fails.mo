// code: F035
// line: 12
// hint: change the arguments
function f
  input Real a;
  output Real b;
algorithm
  assert(a > 0, "a is positive");
  b := sqrt(a);
end f;
model M
  parameter Real p = f(-1);
  Real x = p*time;
end M;
