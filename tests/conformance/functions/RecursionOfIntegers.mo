// section: 12.4.4
// value: x = 3
model RecursionOfIntegers
  function f
    input Integer n;
    output Integer y;
  algorithm
    y := if n <= 1 then 1 else f(n - 1) + 1;
  end f;
  Integer x = f(3);
end RecursionOfIntegers;
