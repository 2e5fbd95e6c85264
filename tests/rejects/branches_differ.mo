// code: F030
// line: 7
// hint: equally many
model M
  Real x, y;
equation
  if time > 1 then
    x = 1;
    y = 2;
  else
    x = 0;
  end if;
end M;
