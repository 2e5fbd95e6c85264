// section: 3.8
// value: y = 3210, p[1] = 2
// A discrete variable that follows from parameters has its value from the first evaluation on: at 0 x[p[k]] is none
model DiscreteThatFollowsParameters
  function pick
    input Real x[:];
    input Integer p[:];
    output Real y;
  protected
    Integer k = 0;
  algorithm
    y := 0;
    while k < size(p, 1) loop
      k := k + 1;
      y := y + 10^k*x[p[k]];
    end while;
  end pick;
  function order "positions by size"
    input Real x[:];
    output Real s[size(x, 1)];
    output Integer p[size(x, 1)];
  protected
    Integer n = 0, k;
  algorithm
    s := x;
    p := 1:size(x, 1);
    while n < size(x, 1) loop
      n := n + 1;
      for i in 1:size(x, 1) - 1 loop
        if s[i] > s[i+1] then
          k := p[i]; p[i] := p[i+1]; p[i+1] := k;
          s[i:i+1] := {s[i+1], s[i]};
        end if;
      end for;
    end while;
  end order;
  parameter Real a[3] = {3, 1, 2};
  Real s[3], y;
  Integer p[3];
equation
  (s, p) = order(a);
  y = pick(a, p);
end DiscreteThatFollowsParameters;
