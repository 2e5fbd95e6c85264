// section: 7.1
// refuse: S003 8
model EquationTwiceInOneClass
  Real x;
equation
  x = time;
equation
  x = time;
end EquationTwiceInOneClass;
