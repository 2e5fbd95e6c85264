// code: R072
// line: 8
// hint: types, records and connectors
model Part
  Real x = 1;
end Part;
model M
  parameter Part p;
end M;
