// section: 3.7.4.1
// refuse: R053 4
model DelayIntoTheFuture
  Real y = delay(time, -1);
end DelayIntoTheFuture;
