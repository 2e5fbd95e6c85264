// section: 3.7.5
// refuse: R020 5
model EdgeOfInteger
  Integer b = if time > 0.5 then 1 else 0;
  Boolean e = edge(b);
end EdgeOfInteger;
