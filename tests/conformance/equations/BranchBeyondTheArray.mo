// section: 10.5
// refuse: R045 5
model BranchBeyondTheArray
  Real x[3] = {1, 2, 3}*time;
  Real y = if time > 0.5 then x[4] else 0;
end BranchBeyondTheArray;
