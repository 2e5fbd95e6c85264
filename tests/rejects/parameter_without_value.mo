// code: F023
// line: 5
// hint: give it one
model M
  parameter Real p;
  Real x = p*time;
end M;
