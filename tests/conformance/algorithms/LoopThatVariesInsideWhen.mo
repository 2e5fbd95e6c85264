// section: 11.2.2
// value: v[1] = 1, v[2] = 2, v[3] = 3, v[4] = 0, t = 18, s at 0.3 = 1, s = 6, n = 6
model LoopThatVariesInsideWhen "where it ends is settled when it begins"
  Integer n(start=1, fixed=true), s(start=0, fixed=true);
  discrete Real v[4](each start=0, each fixed=true), t(start=0, fixed=true);
algorithm
  when sample(0.25, 0.25) then
    t := 0;
    for i in 1:n, j in i:2 loop
      v[i] := i;
      t := t + i*j;
    end for;
    for k in n:-1:1 loop
      if k > 3 then
        break;
      end if;
      v[k] := k;
      t := t + k;
    end for;
    t := t + 5;
    s := 0;
    for i in 1:n loop
      s := s + i;
      n := n + 1;
    end for;
    n := if time > 0.9 then n else min(3, integer(n/2) + 1);
  end when;
end LoopThatVariesInsideWhen;
