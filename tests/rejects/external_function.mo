// code: R094
// line: 12
// hint: csvColumn
function f
  input Real a;
  output Real b;
external "C";
end f;
model M
  Real x;
equation
  x = f(time);
end M;
