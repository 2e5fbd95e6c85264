// section: 11.2.3
// value: i at 0.25 = 2, i at 0.55 = 4, i = 7, s = 28, found = 3, first at 0.95 = 3, big = 10.5, fact = 5040
model LoopsInsideWhen "while and break in a when-statement, of values that change from event to event"
  Integer n(start = 0, fixed = true), i(start = 0, fixed = true), s(start = 0, fixed = true);
  Integer found(start = 0, fixed = true), first(start = 0, fixed = true), fact(start = 1, fixed = true);
  discrete Real big(start = 0, fixed = true);
  Real table[4] = {0.1, 0.2, 0.5, 2}*time;
algorithm
  when sample(0.1, 0.15) then
    n := n + 1;
    i := 0;
    s := 0;
    fact := 1;
    while i < n loop
      i := i + 1;
      s := s + i;
      fact := fact*i;
    end while;
    first := 0;
    for k in 1:4 loop
      if table[k] > 0.3*time then
        first := k;
        break;
      end if;
    end for;
    big := 0.5;
    found := 0;
    while true loop
      big := big + 2.5;
      if big > 10 then
        break;
      end if;
      found := found + 1;
    end while;
  end when;
end LoopsInsideWhen;
