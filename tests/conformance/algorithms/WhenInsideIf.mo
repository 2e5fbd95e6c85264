// section: 11.2.7.2
// refuse: R057 7
model WhenInsideIf
  Real y1(start = 0, fixed = true);
algorithm
  if time > 0.5 then
    when time > 0.7 then
      y1 := 3;
    end when;
  end if;
end WhenInsideIf;
