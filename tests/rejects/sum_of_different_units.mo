// code: U002
// line: 10
// hint: quantity in
model M
  parameter Real J(unit = "kg.m2") = 2;
  parameter Real d(unit = "N.m.s/rad") = 1;
  parameter Real tau(unit = "N.m") = 1;
  Real w(unit = "rad/s", start = 0);
equation
  J*der(w) = tau - d;
end M;
