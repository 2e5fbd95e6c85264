// section: 12.4
// value: y = 120
model Recursion
  function factorial
    input Integer n;
    output Integer y;
  algorithm
    y := if n <= 1 then 1 else n*factorial(n - 1);
  end factorial;
  Integer y = factorial(5);
end Recursion;
