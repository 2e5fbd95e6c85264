// section: 11.2.1
// refuse: R023 14
model MoreTargetsThanResults "In a function, where the second variable has a value already"
  function one
    input Real x;
    output Real a = x;
  algorithm
  end one;
  function f
    input Real x;
    output Real a = 1;
    output Real b = 2;
  algorithm
    (a, b) := one(x);
  end f;
  Real a, b;
equation
  (a, b) = f(time);
end MoreTargetsThanResults;
