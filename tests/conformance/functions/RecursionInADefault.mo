// section: 12.4.4
// value: y = 6, z = 3
model RecursionInADefault "The value of a result calls the function"
  function f
    input Real x;
    output Real y = if x < 0.5 then 0 else x + f(x - 1);
  algorithm
  end f;
  function count
    input Integer n;
    output Integer c = if n <= 0 then 0 else 1 + count(n - 1);
  algorithm
  end count;
  Real y = f(3*time);
  Real z = count(3);
end RecursionInADefault;
