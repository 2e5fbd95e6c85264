// section: 11.2.1
// refuse: R058 6
model ParameterAssigned
  parameter Real p = 1;
algorithm
  p := 2;
end ParameterAssigned;
