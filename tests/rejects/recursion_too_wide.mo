// code: F034
// line: 8
// hint: reach its end
function fib
  input Integer n;
  output Integer r;
algorithm
  r := if n < 2 then n else fib(n - 1) + fib(n - 2);
end fib;
model recursion_too_wide
  Real x(start=1, fixed=true);
  constant Integer a = fib(40);
equation
  der(x) = -a*x;
end recursion_too_wide;
