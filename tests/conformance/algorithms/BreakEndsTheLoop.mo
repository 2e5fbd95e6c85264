// section: 11.2.4
// value: x = 32
model BreakEndsTheLoop
  Real x;
algorithm
  x := 1;
  for i in 1:10 loop
    x := 2*x;
    if noEvent(x > 25) then
      break;
    end if;
  end for;
end BreakEndsTheLoop;
