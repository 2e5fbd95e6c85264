// section: 7.2.5
// value: z = 6
model A
  parameter Real x = 2;
end A;
model B
  A a;
  parameter Real y = 1;
end B;
model EachInArraysOfComponents
  B b[2](each a(x = 3), each y = 2);
  B c[2](a(each x = 3));
  Real z = b[2].a.x + c[1].a.x;
end EachInArraysOfComponents;
