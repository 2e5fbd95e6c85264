// section: 3.7.3
// refuse: R064 4
model ArcSineOfTwo
  Real y = asin(2.0);
end ArcSineOfTwo;
