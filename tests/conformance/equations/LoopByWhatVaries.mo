// section: 8.3.2
// refuse: F021 10
model LoopByWhatVaries
  Integer k(start=1);
  Real x[3];
equation
  when time > 0.5 then
    k = 2;
  end when;
  for i in k:k + 2 loop
    x[i - k + 1] = i;
  end for;
end LoopByWhatVaries;
