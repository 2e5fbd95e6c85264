// code: P003
// line: 9
// hint: elseif
model elsif_of_others
  Real x;
equation
  if time > 1 then
    x = 1;
  elsif time > 0.5 then
    x = 2;
  else
    x = 3;
  end if;
end elsif_of_others;
