// section: 8.4
// refuse: S003 6
model EquationOfAParameter
  parameter Real p = 1;
equation
  p = 2;
end EquationOfAParameter;
