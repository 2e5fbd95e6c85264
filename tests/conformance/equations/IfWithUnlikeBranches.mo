// section: 8.3.4
// refuse: F030 6
model IfWithUnlikeBranches
  Real x, y;
equation
  if time > 0.5 then
    x = 1;
    y = 2;
  else
    x = 2;
  end if;
end IfWithUnlikeBranches;
