// section: 10.4.3
// refuse: R025 5
model StepOfAnotherType
  type E = enumeration(one, two);
  Real x[3] = 1:E.one:3;
end StepOfAnotherType;
