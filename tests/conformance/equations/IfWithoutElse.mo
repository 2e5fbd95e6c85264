// section: 8.3.4
// refuse: F030 6
model IfWithoutElse
  Real x;
equation
  if time > 0.5 then
    x = 1;
  end if;
end IfWithoutElse;
