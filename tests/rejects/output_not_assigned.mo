// code: F033
// line: 6
// hint:
function f
  input Real a;
  output Real b;
protected
  Real c;
algorithm
  c := a + b;
end f;
model M
  Real x = f(time);
end M;
