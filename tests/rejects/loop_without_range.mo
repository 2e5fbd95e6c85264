// code: P018
// line: 7
// hint: for i in 1:n
model M
  Real x[3];
equation
  for i loop
    x[i] = time;
  end for;
end M;
