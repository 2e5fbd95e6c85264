// section: 4.7
// refuse: R070 4
model OperatorOfAModel "operators belong into operator records"
  operator function '+'
    input Real a;
    output Real b;
  algorithm
    b := a;
  end '+';
  Real x = 1;
end OperatorOfAModel;
