// section: 11.2.2
// value: s = 3
model BreakOfNestedLoops "several iterators are loops inside each other, of which break leaves the inner one"
  Real s;
algorithm
  s := 0;
  for i in 1:3, j in 1:3 loop
    if j == 2 then
      break;
    end if;
    s := s + time;
  end for;
end BreakOfNestedLoops;
