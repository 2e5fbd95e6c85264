// code: F020
// line: 5
// hint: bind it
model M
  parameter String name;
  Real x;
equation
  x = if name == "a" then 1 else 2;
end M;
