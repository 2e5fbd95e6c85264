// section: 10.3.4.1
// refuse: P017 9
model IteratorsForAFunctionOfTheUser "a reduction by a function of the user"
  function f
    input Real x[:];
    output Real y = sum(x);
  algorithm
  end f;
  Real x = f(i for i in 1:3);
end IteratorsForAFunctionOfTheUser;
