// section: 7.1
// value: y = 2
model A
  parameter Real x = 2;
end A;
model B
  extends A;
end B;
model InheritedTwice
  extends B;
  extends A;
  Real y = x;
end InheritedTwice;
