// section: 8.3.4
// value: u at 0.2 = 0, i at 0.2 = 2.5, u = 5, i = 0
model UnitsOfBranches "the branches of an if-equation are equations of their own: their units need not agree"
  parameter Real R(unit="Ohm") = 2;
  parameter Real u0(unit="V") = 5;
  Real u(unit="V"), i(unit="A");
equation
  if time < 0.5 then
    u = 0;
  else
    i = 0;
  end if;
  u + R*i = u0;
end UnitsOfBranches;
