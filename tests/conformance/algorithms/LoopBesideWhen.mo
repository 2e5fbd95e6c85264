// section: 11.2.3
// refuse: R059 7
model LoopBesideWhen
  Integer n(start = 0, fixed = true), k(start = 0, fixed = true);
algorithm
  n := 0;
  while n < 3*time loop
    n := n + 1;
  end while;
  when time > 0.5 then
    k := n;
  end when;
end LoopBesideWhen;
