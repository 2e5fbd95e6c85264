// section: 8.3.4
// value: x = 3
model IfOfParameters
  parameter Integer i = 4;
  Real x;
equation
  if i == 4 then
    x = 3;
  else
    x = 4;
  end if;
end IfOfParameters;
