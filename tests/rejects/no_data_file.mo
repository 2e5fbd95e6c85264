// code: F040
// line: 11
// hint: looked in
function csvColumn
  input String fileName;
  input String column;
  output Real values[:];
external "builtin";
end csvColumn;
model M
  parameter Real v[:] = csvColumn("nowhere.csv", "load");
  Real x = v[1]*time;
end M;
