// section: 5.4
// refuse: R013 5
model OuterModelWithoutInner
  model B
    outer model F = G;
    F f;
  end B;
  model G
    Real y = 1;
  end G;
  B b;
end OuterModelWithoutInner;
