// section: 8.3.5
// value: c[1].n = 1, c[2].n = 1, c[3].n = 0, total = 2
model WhenOverConnectors "when in for loops over arrays of connectors"
  connector K
    Real v;
    flow Real i;
  end K;
  model Comp
    K k;
    discrete Integer n(start = 0, fixed = true);
    parameter Real at = 0.3;
  equation
    k.i = -1;
    when k.v > at then
      n = pre(n) + 1;
    end when;
  end Comp;
  model Src
    K k[3];
    Integer hits[3](each start = 0, each fixed = true);
  equation
    for j in 1:3 loop
      k[j].v = time/j;
      when k[j].v > 0.45 then
        hits[j] = pre(hits[j]) + 1;
      end when;
    end for;
  end Src;
  Comp c[3](at = {0.3, 0.4, 0.5});
  Src s;
  Integer total = sum(s.hits);
equation
  connect(s.k, c.k);
end WhenOverConnectors;
