// section: 4.8
// refuse: S003 7
model TooManyEquations
  Real x;
equation
  x = 1;
  x = 2*time;
end TooManyEquations;
