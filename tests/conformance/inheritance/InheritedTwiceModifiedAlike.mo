// section: 7.1
// value: y = 5
model A
  parameter Real x = 2;
end A;
model B
  extends A;
end B;
model InheritedTwiceModifiedAlike
  extends B(x = 5);
  extends A(x = 5);
  Real y = x;
end InheritedTwiceModifiedAlike;
