// section: 4.5.1
// refuse: R072 7
model InputOfAModel
  model B
    Real x = 1;
  end B;
  model A = input B;
  A a;
end InputOfAModel;
