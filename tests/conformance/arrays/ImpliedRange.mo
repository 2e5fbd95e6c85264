// section: 11.2.2.1
// value: x[1] = 2, x[3] = 6, s = 12
model ImpliedRange
  Real x[3], s = sum(x[i] for i);
equation
  for i loop
    x[i] = 2*i;
  end for;
end ImpliedRange;
