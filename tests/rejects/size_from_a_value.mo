// code: F036
// line: 15
// hint: sizes of arguments
function f
  input Integer n;
  output Real b;
protected
  Real work[n];
algorithm
  work := ones(n);
  b := sum(work);
end f;
model M
  Integer k(start = 1);
  Real x = f(k);
equation
  when time > 1 then
    k = 2;
  end when;
end M;
