// code: R001
// line: 10
// hint: did you mean Resistor
model Resistor
  Real i;
equation
  i = time;
end Resistor;
model M
  Resistr r;
end M;
