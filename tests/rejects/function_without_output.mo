// code: R004
// line: 10
// hint: call it as a statement
function quiet
  input Real u;
algorithm
end quiet;
model M
equation
  time = quiet(time);
end M;
