// section: 11.2.2.1
// value: a[2,3] = 6, a[1,1] = 1
model ImpliedRangeOfTwo
  Real a[2, 3];
equation
  for i, j loop
    a[i, j] = i*j;
  end for;
end ImpliedRangeOfTwo;
