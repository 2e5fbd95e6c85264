// section: 5.4
// value: y = 1, z = 2
model InnerInside
  model C
    outer Real T;
    Real y = T;
  end C;
  model B
    inner Real T = 2;
    C c;
  end B;
  inner Real T = 1;
  C c;
  B b;
  Real y = c.y;
  Real z = b.c.y;
end InnerInside;
