// section: 4.4.3
// refuse: F022 5
model ParameterOfItsOwnElements
  parameter Integer n = 3;
  parameter Real x[n] = cat(1, {3.4}, x[1:(n-1)]);
end ParameterOfItsOwnElements;
