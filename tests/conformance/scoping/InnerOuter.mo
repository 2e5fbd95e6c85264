// section: 5.4
// value: a.b.y = 5
model InnerOuter
  model B
    outer Real t;
    Real y = t;
  end B;
  model A
    B b;
  end A;
  inner Real t = 5;
  A a;
end InnerOuter;
