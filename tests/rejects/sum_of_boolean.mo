// code: R021
// line: 8
// hint: if b then 1 else 0
model M
  Boolean b = time > 1;
  Real x;
equation
  x = 2 + b;
end M;
