// code: F034
// line: 10
// hint: reach its end
function f
  input Real a;
  output Real b;
algorithm
  b := a;
  while b > 0 loop
    b := b + 1;
  end while;
end f;
model M
  parameter Real p = f(1);
  Real x = p*time;
end M;
