// code: U001
// line: 11
// hint: correct a declared unit
model units_of_a_branch
  parameter Real R(unit="Ohm") = 2;
  Real u(unit="V"), i(unit="A");
equation
  if time < 0.5 then
    u = 0;
  else
    i = u;
  end if;
  u + R*i = u;
end units_of_a_branch;
