// section: 5.4
// value: b.f.y = 20
model InnerModel
  replaceable function g
    input Real x;
    output Real y;
  algorithm
    y := x;
  end g;
  model B
    outer model F
      Real y = 1;
    end F;
    F f;
  end B;
  inner model F
    Real y = 20;
    Real z = 3;
  end F;
  B b;
end InnerModel;
