// section: 11.2.6
// value: y = 3, y at 0.1 = 1, y at 0.5 = 2
model IfElseif
  Real y;
algorithm
  if time < 0.3 then
    y := 1;
  elseif time < 0.7 then
    y := 2;
  else
    y := 3;
  end if;
end IfElseif;
