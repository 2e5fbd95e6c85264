// section: 4.8
// refuse: S003 8
model EqualitiesInACircle
  Real x;
  Real y;
equation
  x = y;
  y = x;
end EqualitiesInACircle;
