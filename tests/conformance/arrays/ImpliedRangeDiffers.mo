// section: 11.2.2.1
// refuse: R047 7
model ImpliedRangeDiffers
  Real x[3], y[4];
equation
  for i loop
    x[i] = y[i];
  end for;
  y = ones(4);
end ImpliedRangeDiffers;
