// section: 5.4
// value: d.y = 6
partial function A
  input Real u;
  output Real y;
end A;
function B
  extends A;
algorithm
  y := 3*u;
end B;
model D
  outer function fc = A;
  Real y = fc(2);
end D;
model OuterFunction
  inner function fc = B;
  D d;
end OuterFunction;
