// section: 12.4.1
// refuse: R050 10
model TooManyArguments
  function f
    input Real a;
    output Real c;
  algorithm
    c := a;
  end f;
  Real y = f(1, 2);
end TooManyArguments;
