// section: 4.4.2.2
// refuse: R072 4
model ParameterInput "an input may vary"
  parameter input Real k = 2;
  Real x = k;
end ParameterInput;
