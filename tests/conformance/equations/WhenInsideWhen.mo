// section: 8.3.5.1
// refuse: R057 9
model WhenInsideWhen
  Integer n(start=0);
  Integer m(start=0);
equation
  when time > 0.3 then
    n = 1;
    when time > 0.5 then
      m = 1;
    end when;
  end when;
end WhenInsideWhen;
