// section: 11.1.1
// value: hist[1] = 3, hist[2] = 2, hist[4] = 2, r[1] = 3, r[2] = 2, r[3] = 1, a = 1, t = 2, again = 2
model CountersByAVaryingIndex "An element that is chosen in the run, counted up; and elements changed round"
  Integer hist[4](each start = 0, each fixed = true);
  Integer bin(start = 1, fixed = true);
  Integer a(start = 1, fixed = true), r[3](start = {1, 2, 3}, each fixed = true), t(start = 0, fixed = true);
  Integer k(start = 0, fixed = true), again(start = 0, fixed = true) "what was counted of this element before";
algorithm
  when sample(0.1, 0.1) then
    k := k + 1;
    if k < 10 then
      bin := mod(k - 1, 4) + 1;
      again := pre(hist[bin]);
      hist[bin] := hist[bin] + 1;
      a := mod(a, 3) + 1;
      t := r[a];
      r[a] := r[mod(a, 3) + 1];
      r[mod(a, 3) + 1] := t;
    end if;
  end when;
end CountersByAVaryingIndex;
