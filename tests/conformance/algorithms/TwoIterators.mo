// section: 11.2.2
// value: x[4,2] = 6, x[4,3] = 0
model TwoIterators
  Real x[4, 3];
algorithm
  x := zeros(4, 3);
  for j, i in 1:2 loop
    x[j, i] := j + i;
  end for;
end TwoIterators;
