// code: R014
// line: 11
// hint: model, block
function f
  input Real a;
  output Real b;
algorithm
  b := a;
end f;
model M
  f g;
end M;
