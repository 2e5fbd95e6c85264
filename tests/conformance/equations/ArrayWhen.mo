// section: 8.3.5
// value: n[1] = 1, n[2] = 1, n[3] = 0
model ArrayWhen "a when-clause for each element"
  Integer n[3](each start=0, each fixed=true);
equation
  for i in 1:3 loop
    when time > 0.4*i then
      n[i] = pre(n[i]) + 1;
    end when;
  end for;
end ArrayWhen;
