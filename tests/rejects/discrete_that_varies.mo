// code: R063
// line: 7
// hint: at events
model M
  discrete Real x;
equation
  x = sin(time);
end M;
