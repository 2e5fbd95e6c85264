// section: 8.3.3
// refuse: S003 8
model IteratorSet
  Real x[3];
equation
  for i in 1:3 loop
    x[i] = 1;
    i = 2;
  end for;
end IteratorSet;
