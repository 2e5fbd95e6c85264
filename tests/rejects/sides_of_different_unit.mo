// code: U001
// line: 9
// hint: quantity in
model M
  parameter Real R(unit = "Ohm") = 2;
  parameter Real i(unit = "A") = 0.5;
  Real v(unit = "V");
equation
  v = R*i*i;
end M;
