// section: 3.7.3
// refuse: R064 4
model ArcCosineOfMinusTwo
  Real y = acos(-2);
end ArcCosineOfMinusTwo;
