// section: 5.4
// refuse: R076 9
model OuterModifiedOutside
  model B
    outer Real t;
    Real y = t;
  end B;
  inner Real t = 5;
  B b(t=2);
end OuterModifiedOutside;
