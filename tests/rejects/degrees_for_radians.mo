// code: U004
// line: 8
// hint: convert
model M
  Real phi(unit = "rad");
  parameter Real phi0(unit = "deg") = 30;
equation
  phi = phi0;
end M;
