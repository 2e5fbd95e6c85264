// section: 3.7.4.1
// refuse: R054 5
model DelayDifferentiated
  Real x = sin(time);
  Real y = der(delay(x, 0.5));
end DelayDifferentiated;
