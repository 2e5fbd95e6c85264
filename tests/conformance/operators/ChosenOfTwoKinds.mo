// section: 3.7.2, 6.7, 10.3.4, 10.6
// refuse: R024 5
model ChosenOfTwoKinds "the type of an expression does not depend on its values"
  parameter Integer k = 3;
  Integer n = if true then 1 else 2.5;
end ChosenOfTwoKinds;
