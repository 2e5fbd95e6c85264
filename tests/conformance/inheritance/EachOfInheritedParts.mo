// section: 7.2.5
// value: b[2].x = 3
model Base
  Real x;
equation
  der(x) = 0;
end Base;
model Derived
  extends Base(x(start=0));
end Derived;
model EachOfInheritedParts
  Derived b[2](x(each start=3, fixed={true, true}));
end EachOfInheritedParts;
