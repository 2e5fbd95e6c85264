// section: 4.5.1
// value: x[3] = 1
type InArgument = input Real;
type OutArgument = output Real[3];
function foo
  InArgument u;
  OutArgument y;
algorithm
  y := fill(u, 3);
end foo;
model DirectionByTypeName
  Real x[:] = foo(time);
end DirectionByTypeName;
