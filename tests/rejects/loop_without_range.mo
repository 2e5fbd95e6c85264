// code: R047
// line: 7
// hint: say what it runs over
model M
  Real x[3];
equation
  for i loop
    x[2*i] = time;
  end for;
end M;
