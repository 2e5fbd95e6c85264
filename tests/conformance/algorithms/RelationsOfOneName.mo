// section: 8.5
// value: x = 3.5, i = 2, i at 0.2 = 0
model RelationsOfOneName
  Real x;
  Integer i;
algorithm
  i := 0;
  x := sin(3*time + 0.1);
  if x < 0 then
    i := 1;
  end if;
  x := cos(3*time);
  if x < 0 then
    i := i + 2;
  end if;
  x := 3.5;
end RelationsOfOneName;
