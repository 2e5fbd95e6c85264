// section: 11.1.2
// value: x at 0.2 = 3, x = 5
model StartBeforeAssignment
  Real x(start=3);
algorithm
  if time > 0.5 then
    x := 5;
  end if;
end StartBeforeAssignment;
