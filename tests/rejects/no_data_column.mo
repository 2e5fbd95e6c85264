// code: F041
// line: 11
// hint: did you mean torque
function csvColumn
  input String fileName;
  input String column;
  output Real values[:];
external "builtin";
end csvColumn;
model M
  parameter Real v[:] = csvColumn("load.csv", "torqe");
  Real x = v[1]*time;
end M;
