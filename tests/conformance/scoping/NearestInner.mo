// section: 5.4
// value: a.b.y = 6, b.y = 5
model NearestInner
  model B
    outer Real t;
    Real y = t;
  end B;
  model A
    inner Real t = 6;
    B b;
  end A;
  inner Real t = 5;
  A a;
  B b;
end NearestInner;
