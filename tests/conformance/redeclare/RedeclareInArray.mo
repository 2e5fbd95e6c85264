// section: 7.3
// value: b[2].a.y = 5
model RedeclareInArray "each element of an array of components"
  model A
    Real y = 1*time;
  end A;
  model A2
    extends A(y=5*time);
  end A2;
  model B
    replaceable A a;
  end B;
  B b[2](redeclare each A2 a);
end RedeclareInArray;
