// code: P021
// line: 5
// hint: then one of discrete, parameter, constant
model M
  parameter constant Real x = 1;
end M;
