// section: 11.2.2.1
// refuse: R047 6
model ImpliedRangeOfNothing
  Real x[3];
equation
  for i loop
    x[2] = time;
  end for;
end ImpliedRangeOfNothing;
