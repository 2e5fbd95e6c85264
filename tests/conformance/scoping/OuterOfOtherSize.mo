// section: 5.4
// refuse: R076 5
model OuterOfOtherSize
  model B
    outer Real t;
    Real y = t;
  end B;
  inner Real t[2] = {5, 6};
  B b;
end OuterOfOtherSize;
