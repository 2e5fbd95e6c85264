// code: R092
// line: 5
// hint: replaceable components
model M
  replaceable model Part = Real;
  Real x = time;
end M;
