// section: 5.4
// value: b.f.y = 2, c.b.f.y = 3
model InnerShortModels
  model B
    outer model F = G;
    F f;
  end B;
  model G
    Real y = 1;
  end G;
  model C
    inner model F = G(y=3);
    B b;
  end C;
  inner model F = G(y=2);
  B b;
  C c;
end InnerShortModels;
