// code: F034
// line: 8
// hint: reach its end
function rec
  input Real n;
  output Real r;
algorithm
  r := rec(n + 1);
end rec;
model recursion_without_end
  Real x(start=1, fixed=true);
  constant Real a = rec(1);
equation
  der(x) = -a*x;
end recursion_without_end;
