// section: 11.2.4
// value: n[1] = 2, n[2] = 1
model BreakOfTheInnerLoop
  Real a[2, 3] = [1, 6, 7; 8, 1, 1];
  Integer n[2];
algorithm
  for i in 1:2 loop
    for j in 1:3 loop
      if a[i, j] > 5 then
        n[i] := j;
        break;
      end if;
    end for;
  end for;
end BreakOfTheInnerLoop;
