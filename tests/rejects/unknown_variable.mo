// code: R002
// line: 7
// hint: did you mean speed
model M
  Real speed;
equation
  sped = time;
end M;
