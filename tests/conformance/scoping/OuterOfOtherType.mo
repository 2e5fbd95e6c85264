// section: 5.4
// refuse: R076 5
model OuterOfOtherType
  model B
    outer Boolean t;
    Boolean y = t;
  end B;
  inner Real t = 5;
  B b;
end OuterOfOtherType;
