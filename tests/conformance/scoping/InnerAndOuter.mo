// section: 5.4
// value: s.c.y = 8, s.z = 5
model InnerAndOuter
  model C
    outer Real t;
    Real y = t;
  end C;
  model S
    inner outer Real t = t + 3;
    Real z = t;
    C c;
  end S;
  inner Real t = 5;
  S s;
end InnerAndOuter;
