// section: 11.2.3
// value: s = 6, y[3] = 3
model BreakBeforeTheEnd "for with break in an algorithm"
  Real y[3], s;
algorithm
  s := 0;
  for i in 1:5 loop
    if i > 3 then
      break;
    end if;
    y[i] := i*time;
    s := s + y[i];
  end for;
end BreakBeforeTheEnd;
