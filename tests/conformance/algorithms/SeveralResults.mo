// section: 11.2.1.1
// value: a = 3, b = 2
model SeveralResults
  function f
    input Real x;
    output Real a = 3*x;
    output Real b = 2*x;
  algorithm
  end f;
  Real a, b;
algorithm
  (a, b) := f(time);
end SeveralResults;
