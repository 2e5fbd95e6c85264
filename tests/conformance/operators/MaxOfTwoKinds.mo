// section: 3.7.2, 6.7, 10.3.4, 10.6
// refuse: R024 5
model MaxOfTwoKinds "the type of an expression does not depend on its values"
  parameter Integer k = 3;
  Integer n = max(7, 2.0);
end MaxOfTwoKinds;
