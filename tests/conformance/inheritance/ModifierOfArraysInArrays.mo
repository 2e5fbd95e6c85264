// section: 7.2.5
// value: a[2].b[3].p = 6, a[1].b[1].p = 1
model ModifierOfArraysInArrays
  model B
    parameter Real p = 0;
  end B;
  model A
    B b[3];
  end A;
  A a[2](b(p={{1, 2, 3}, {4, 5, 6}}));
end ModifierOfArraysInArrays;
