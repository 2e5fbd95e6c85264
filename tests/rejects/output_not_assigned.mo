// code: F033
// line: 6
// hint:
function f
  input Real a;
  output Real b;
algorithm
  if a > 0 then
    b := a;
  end if;
end f;
model M
  Real x = f(time);
end M;
