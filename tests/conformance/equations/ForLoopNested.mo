// section: 8.3.3
// value: a[1,2] = 12, a[2,3] = 23
model ForLoopNested
  Real a[2, 3];
equation
  for i in 1:2, j in 1:3 loop
    a[i, j] = 10*i + j;
  end for;
end ForLoopNested;
