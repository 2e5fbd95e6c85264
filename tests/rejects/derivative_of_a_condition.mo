// code: R054
// line: 7
// hint: only Reals
model derivative_of_a_condition
  Real x;
equation
  x = der(time > 0.5);
end derivative_of_a_condition;
