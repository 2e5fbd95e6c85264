// section: 8.6
// refuse: F021 5
model WholeNumberUndetermined
  parameter Integer n(fixed=false);
  Real x[n];
initial equation
  n = 3;
equation
  for i in 1:n loop
    x[i] = i;
  end for;
end WholeNumberUndetermined;
