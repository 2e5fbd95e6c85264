// section: 5.3.1
// value: y = 3
model ModifierOfOuterName
  model A
    parameter Real p = 1;
    Real y = p;
  end A;
  parameter Real p = 3;
  A a(p=p);
  Real y = a.y;
end ModifierOfOuterName;
